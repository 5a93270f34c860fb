#pragma once
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace placegraph::test {

/// The data in a page that `placegraph report` or `--report` wrote.
inline nlohmann::json report_in(const std::string& file) {
  const std::string page = read_file(file);
  const std::string begin = "<script id=\"placegraph-report\" type=\"application/json\">";
  const std::size_t at = page.find(begin);
  EXPECT_NE(at, std::string::npos) << file;
  if (at == std::string::npos) return {};
  const std::size_t first = at + begin.size();
  return nlohmann::json::parse(page.substr(first, page.find("</script>", first) - first));
}

/// Number of rows of a column of floats or integers of 32 bits; base64 hides up to two bytes.
inline std::size_t rows_in(const nlohmann::json& column) {
  const std::string data = column["data"].get<std::string>();
  return data.size() / 4 * 3 / (4 * column["width"].get<std::size_t>());
}

/// The values of a column of doubles.
inline std::vector<double> doubles_in(const nlohmann::json& column) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : column["data"].get<std::string>()) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 255);
  }
  std::vector<double> values(bytes.size() / sizeof(double));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(double));
  return values;
}

}  // namespace placegraph::test
