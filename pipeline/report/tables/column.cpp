#include <placegraph/pipeline/report/tables/column.h>

#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/base64.h>

#include <algorithm>
#include <bit>
#include <cstring>
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

std::size_t row_bytes(const json& column) {
  const std::string& type = column["type"].get_ref<const std::string&>();
  return (type == "u8" ? 1U : type == "f64" ? 8U : 4U) * column["width"].get<std::size_t>();
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

std::vector<float> values_of(const json& column) {
  const std::string bytes = from_base64(column["data"].get_ref<const std::string&>());
  std::vector<float> values(bytes.size() / 4);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const char* at = bytes.data() + 4 * i;
    if (column["type"] == "i32") {
      std::int32_t value = 0;
      std::memcpy(&value, at, sizeof value);
      values[i] = static_cast<float>(value);
    } else {
      std::memcpy(&values[i], at, sizeof(float));
    }
  }
  return values;
}

std::size_t rows_of(const json& column) {
  const std::string& data = column["data"].get_ref<const std::string&>();
  const auto padding = static_cast<std::size_t>(std::ranges::count(data, '='));
  return (data.size() / 4 * 3 - padding) / row_bytes(column);
}

json rows_of_column(const json& column, const std::vector<std::size_t>& rows) {
  if (column.is_null()) return column;
  if (column.contains("table")) {
    const std::string bytes = from_base64(column["index"]["data"].get_ref<const std::string&>());
    std::vector<std::string> texts;
    for (const std::size_t row : rows) {
      std::int32_t index = -1;
      std::memcpy(&index, bytes.data() + sizeof index * row, sizeof index);
      texts.push_back(index < 0 ? "" : column["table"][static_cast<std::size_t>(index)]);
    }
    return text_column(texts);
  }
  const std::string bytes = from_base64(column["data"].get_ref<const std::string&>());
  const std::size_t size = row_bytes(column);
  std::string kept;
  for (const std::size_t row : rows) kept.append(bytes, size * row, size);
  json result = column;
  result["data"] = to_base64(kept);
  return result;
}

std::size_t page_bytes(const json& part) {
  const std::string text = part.dump(-1, ' ', false, json::error_handler_t::replace);
  constexpr std::size_t kEscaped = 5;  // "<" is "\u003c"
  return text.size() + kEscaped * static_cast<std::size_t>(std::ranges::count(text, '<'));
}

}  // namespace placegraph::report
