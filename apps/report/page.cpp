#include "apps/report/page.h"

#include <placegraph/graph/core/error.h>

#include <nlohmann/json.hpp>

// The bytes of the page, between two symbols.
asm(".pushsection .rodata, \"a\"\n"
    ".global placegraph_page_begin\n"
    "placegraph_page_begin:\n"
    ".incbin \"" PLACEGRAPH_PAGE
    "\"\n"
    ".global placegraph_page_end\n"
    "placegraph_page_end:\n"
    ".byte 0\n"
    ".popsection\n");

extern "C" {
extern const char placegraph_page_begin[] __attribute__((visibility("hidden")));
extern const char placegraph_page_end[] __attribute__((visibility("hidden")));
}

namespace placegraph::apps {

std::string_view empty_page() {
  return {placegraph_page_begin,
          static_cast<std::size_t>(placegraph_page_end - placegraph_page_begin)};
}

std::string page_with(const nlohmann::json& data) {
  constexpr std::string_view kMarker = "<!--placegraph-report-->";
  const std::string_view page = empty_page();
  const std::size_t at = page.find(kMarker);
  require(at != std::string_view::npos, "the page has no place for its data");
  std::string result(page.substr(0, at));
  result += "<script id=\"placegraph-report\" type=\"application/json\">";
  for (const char c : data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace))
    c == '<' ? result += "\\u003c" : result += c;
  result += "</script>";
  result += page.substr(at + kMarker.size());
  return result;
}

}  // namespace placegraph::apps
