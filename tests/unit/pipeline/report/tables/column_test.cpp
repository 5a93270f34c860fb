#include <placegraph/pipeline/report/tables/column.h>

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/base64.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace placegraph::report {
namespace column_test {

TEST(ReportColumn, HasLittleEndianValues) {
  const nlohmann::json numbers = column(std::vector<std::int32_t>{1, -1, 256, 0}, 2);
  EXPECT_EQ(numbers["type"], "i32");
  EXPECT_EQ(numbers["width"], 2);
  EXPECT_EQ(numbers["data"],
            to_base64(std::string_view("\1\0\0\0\xff\xff\xff\xff\0\1\0\0\0\0\0\0", 16)));
  EXPECT_EQ(column(std::vector<float>{1})["data"], to_base64(std::string_view("\0\0\x80\x3f", 4)));
  EXPECT_EQ(column(std::vector<double>{1})["type"], "f64");
  EXPECT_EQ(column(std::vector<std::uint8_t>{'f', 'o', 'o'}, 3)["data"], "Zm9v");
  EXPECT_THROW((void)column(std::vector<float>{1, 2, 3}, 2), ArgumentError);
}

TEST(ReportColumn, NamesEveryTextOnce) {
  const nlohmann::json texts = text_column({"lost", "", "blank", "lost"});
  EXPECT_EQ(texts["table"], (std::vector<std::string>{"lost", "blank"}));
  EXPECT_EQ(texts["index"], column(std::vector<std::int32_t>{0, -1, 1, 0}));
}

}  // namespace column_test
}  // namespace placegraph::report
