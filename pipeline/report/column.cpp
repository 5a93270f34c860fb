#include <placegraph/pipeline/report/column.h>

#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/base64.h>

#include <bit>
#include <map>
#include <nlohmann/json.hpp>

namespace placegraph::report {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "columns are little-endian");

template <class Value>
json column_of(const char* type, const std::vector<Value>& values, int width) {
  require(width > 0 && values.size() % static_cast<std::size_t>(width) == 0,
          "column: the values are no whole number of rows");
  const std::string_view bytes(reinterpret_cast<const char*>(values.data()),
                               values.size() * sizeof(Value));
  return {{"type", type}, {"width", width}, {"data", to_base64(bytes)}};
}

}  // namespace

json column(const std::vector<float>& values, int width) { return column_of("f32", values, width); }
json column(const std::vector<double>& values, int width) {
  return column_of("f64", values, width);
}
json column(const std::vector<std::int32_t>& values, int width) {
  return column_of("i32", values, width);
}
json column(const std::vector<std::uint8_t>& values, int width) {
  return column_of("u8", values, width);
}

json text_column(const std::vector<std::string>& texts) {
  std::map<std::string, std::int32_t> numbers;
  json table = json::array();
  std::vector<std::int32_t> index;
  for (const std::string& text : texts) {
    if (text.empty()) {
      index.push_back(-1);
      continue;
    }
    const auto [number, added] =
        numbers.try_emplace(text, static_cast<std::int32_t>(numbers.size()));
    if (added) table.push_back(text);
    index.push_back(number->second);
  }
  return {{"table", table}, {"index", column(index)}};
}

}  // namespace placegraph::report
