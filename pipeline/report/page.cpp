#include <placegraph/pipeline/report/page.h>

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/report/served_page.h>

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

namespace placegraph::report {

std::string_view empty_page() {
  return {placegraph_page_begin,
          static_cast<std::size_t>(placegraph_page_end - placegraph_page_begin)};
}

namespace {

/// The page with data, JSON, in a script element that has an id.
std::string page_with_script(const char* id, const std::string& data) {
  constexpr std::string_view kMarker = "<!--placegraph-report-->";
  const std::string_view page = empty_page();
  const std::size_t at = page.find(kMarker);
  require(at != std::string_view::npos, "the page has no place for its data");
  std::string result(page.substr(0, at));
  result += fmt::format("<script id=\"{}\" type=\"application/json\">", id);
  for (const char c : data) c == '<' ? result += "\\u003c" : result += c;
  result += "</script>";
  result += page.substr(at + kMarker.size());
  return result;
}

}  // namespace

std::string page_with(const nlohmann::json& data) {
  return page_with_script("placegraph-report",
                          data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace placegraph::report

namespace placegraph {

std::string served_page(const std::string& start_json, const std::string& nonce) {
  constexpr std::string_view kPolicy = "<meta http-equiv=\"Content-Security-Policy\"";
  constexpr std::string_view kNonce = "placegraph-nonce";
  std::string page = report::page_with_script("placegraph-live", start_json);
  const std::size_t policy = page.find(kPolicy);
  require(policy != std::string::npos, "the page has no content security policy");
  page.erase(policy, page.find('>', policy) + 1 - policy);
  for (std::size_t at = page.find(kNonce); at != std::string::npos; at = page.find(kNonce, at))
    page.replace(at, kNonce.size(), nonce);
  return page;
}

}  // namespace placegraph
