#include <gtest/gtest.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/text/csv_text.h>

#include <vector>

namespace placegraph {
namespace csv_text_test {

using Rows = std::vector<std::vector<std::string>>;

/// The fields of a table, by the grammar of RFC 4180.
Rows read_csv(const std::string& text) {
  Rows rows;
  std::vector<std::string> row;
  std::string field;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') {
      const bool doubled = quoted && i + 1 < text.size() && text[i + 1] == '"';
      if (doubled) field += text[++i];
      quoted = doubled || !quoted;
    } else if (quoted || (c != ',' && c != '\n')) {
      field += c;
    } else {
      row.push_back(std::move(field));
      field.clear();
      if (c == '\n') rows.push_back(std::move(row)), row.clear();
    }
  }
  return rows;
}

TEST(CsvText, IsReadAsItWasWritten) {
  const std::string letters = "a,\"\r\n; 7\xc3\xa4";
  const auto count = static_cast<int>(letters.size());
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Rows rows;
    CsvText csv;
    const int columns = 1 + random.index(4);
    for (int r = random.index(5); r >= 0; --r) {
      std::vector<std::string>& row = rows.emplace_back();
      for (int c = 0; c < columns; ++c) {
        std::string& field = row.emplace_back();
        for (int i = random.index(6); i > 0; --i)
          field += letters[static_cast<std::size_t>(random.index(count))];
        csv.add(field);
      }
      csv.end_row();
    }
    EXPECT_EQ(read_csv(csv.text()), rows) << csv.text();
  }
}

TEST(CsvText, QuotesOnlyWhatNeedsIt) {
  CsvText csv;
  csv.row("name", "a b", 0.5, 7, "");
  csv.row("a, \"b\"", "two\nlines", -1, true, "x");
  EXPECT_EQ(csv.text(),
            "name,a b,0.5,7,\n"
            "\"a, \"\"b\"\"\",\"two\nlines\",-1,true,x\n");
}

}  // namespace csv_text_test
}  // namespace placegraph
