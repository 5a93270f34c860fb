#pragma once
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

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

}  // namespace placegraph::test
