#include <fmt/core.h>
#include <placegraph/graph/text/csv_text.h>

namespace placegraph {

CsvText& CsvText::add(std::string_view field) {
  if (begun_) text_ += ',';
  begun_ = true;
  const bool quoted = field.find_first_of(",\"\r\n") != std::string_view::npos;
  if (quoted) text_ += '"';
  for (const char c : field) text_.append(quoted && c == '"' ? 2 : 1, c);
  if (quoted) text_ += '"';
  return *this;
}

CsvText& CsvText::add(double field) { return add(fmt::format("{}", field)); }

CsvText& CsvText::add(float field) { return add(fmt::format("{}", field)); }

}  // namespace placegraph
