#include <placegraph/pipeline/report/page.h>
#include <placegraph/pipeline/report/served_page.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

#include <placegraph/pipeline/report/map_part.h>

namespace placegraph::report {
namespace page_test {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

/// The text of the script element with this id.
std::string script_of(const std::string& page, const std::string& id) {
  const std::string begin = "<script id=\"" + id + "\" type=\"application/json\">";
  const std::size_t at = page.find(begin);
  if (at == std::string::npos) return {};
  const std::size_t first = at + begin.size();
  return page.substr(first, page.find("</script>", first) - first);
}

TEST(Page, HoldsItsDataWhateverTheirTexts) {
  const json data = {{"title", "</script><script>alert(1)</script><!--"},
                     {"names", {"a & b", "\xc3\xa4", "\"quoted\"\n"}},
                     {"number", 1e-3}};
  const std::string page = page_with(data), script = script_of(page, "placegraph-report");
  EXPECT_EQ(json::parse(script), data);
  EXPECT_THAT(script, Not(HasSubstr("<")));
  EXPECT_EQ(json::parse(script_of(page_with({{"bytes", "a\xff"}}), "placegraph-report"))["bytes"],
            "a\xef\xbf\xbd");
}

TEST(Page, IsTheEmptyPageButForItsData) {
  const std::string_view empty = empty_page();
  const std::string page = page_with(json::object());
  const std::string script =
      "<script id=\"placegraph-report\" type=\"application/json\">{}</script>";
  const std::size_t at = page.find(script);
  ASSERT_NE(at, std::string::npos);
  EXPECT_TRUE(empty.starts_with(page.substr(0, at)));
  EXPECT_TRUE(empty.ends_with(page.substr(at + script.size())));
}

TEST(Page, OfAServerLeavesThePolicyToIt) {
  const std::string page = served_page(R"({"kind": "view"})", "abc123");
  EXPECT_EQ(json::parse(script_of(page, "placegraph-live"))["kind"], "view");
  EXPECT_EQ(script_of(page, "placegraph-report"), "");
  EXPECT_THAT(page, HasSubstr("nonce=\"abc123\""));
  EXPECT_THAT(page, Not(HasSubstr("placegraph-nonce")));
  EXPECT_THAT(page, Not(HasSubstr("http-equiv=\"Content-Security-Policy\"")));
  EXPECT_THAT(page_with({}), HasSubstr("http-equiv=\"Content-Security-Policy\""));
}

// The rows are 0, 1, 2, ... without gaps, as a column of a report has them.
TEST(LandmarkRows, ManyLandmarksAreLeftOutEvenlyAndNoMoreThanMust) {
  std::vector<std::size_t> numbers = {0, 1, LandmarkRows::kMost - 1};
  for (std::size_t times = 1; times <= 3; ++times)
    for (const std::size_t more : {0, 1, 7}) numbers.push_back(times * LandmarkRows::kMost + more);
  for (const std::size_t landmarks : numbers) {
    const LandmarkRows rows(landmarks);
    std::size_t next = 0, last = 0;
    for (std::size_t i = 0; i < landmarks; ++i) {
      const auto row = rows.row_of(i);
      if (!row) continue;
      ASSERT_EQ(*row, next++);
      ASSERT_EQ(i, next == 1 ? 0 : last + rows.step());
      last = i;
    }
    EXPECT_LE(next, LandmarkRows::kMost) << landmarks;
    const std::size_t smaller_step = rows.step() - 1;
    EXPECT_TRUE(smaller_step == 0 || landmarks > smaller_step * LandmarkRows::kMost) << landmarks;
  }
}

}  // namespace page_test
}  // namespace placegraph::report
