#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/gate/gate.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/unit/eval/gate/gate_worlds.h"

namespace placegraph {
namespace gate_report_test {

using namespace gate_worlds;
using testing::HasSubstr;
using testing::Not;

GateResult mixed() {
  const Record before =
      record_of({{"a", {1.0}}, {"b", {1.0}}, {"c", {1.0}}, {"d <&\"'> | *\x01", {1.0}}, {"s", {1.0}}});
  const Record after =
      record_of({{"a", {1.0}}, {"b", {0.5}}, {"c", {1.2}}, {"d <&\"'> | *\x01", {2.0}}, {"s", {1.0}}});
  return judge(before, after, parse_rules("* | s | significant\n* | * | worse 5 %", "r"));
}

TEST(GateReport, TextHasTheVerdictFirstAndTheWorstAtTheTop) {
  const std::string text = to_text(mixed());
  EXPECT_THAT(text, testing::StartsWith("Regressed: 2 of 5 figures are worse; the worst is 00 d"));
  EXPECT_LT(text.find("+100 %"), text.find("+20 %"));
  EXPECT_LT(text.find("+20 %"), text.find("-50 %"));
  EXPECT_THAT(text, HasSubstr("5 figures: 2 regressed, 1 cannot be judged, 1 improved, 1 same."));
  EXPECT_THAT(to_text(mixed(), false), Not(HasSubstr("\nsame ")));
  EXPECT_THAT(text, HasSubstr("\nsame "));
}

TEST(GateReport, JsonHoldsEveryFigure) {
  const auto json = nlohmann::json::parse(to_json(mixed()));
  EXPECT_EQ(json.at("verdict"), "regressed");
  EXPECT_EQ(json.at("exit_code"), 1);
  ASSERT_EQ(json.at("figures").size(), 5u);
  EXPECT_EQ(json.at("figures")[0].at("before"), 1.0);
  EXPECT_EQ(json.at("figures")[0].at("after"), 2.0);
  EXPECT_EQ(json.at("figures")[2].at("runs_needed"), 5);
}

TEST(GateReport, MarkdownFoldsWhatIsAllRight) {
  const std::string page = to_markdown(mixed());
  EXPECT_THAT(page, testing::StartsWith("### Regressed\n"));
  EXPECT_LT(page.find("| **regressed** | 00 | d &lt;&\"'> \\| \\*"), page.find("<details>"));
  EXPECT_LT(page.find("<details>"), page.find("| same | 00 | a |"));
  // Every row of a table has as many cells.
  std::size_t rows = 0;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("|")) continue;
    ++rows;
    int bars = 0;
    for (std::size_t i = 0; i < line.size(); ++i) bars += line[i] == '|' && line[i - 1] != '\\';
    EXPECT_EQ(bars, 8) << line;
  }
  EXPECT_EQ(rows, 9u);
}

TEST(GateReport, JUnitEscapesWhatXmlDoesNotAllow) {
  const std::string xml = to_junit(mixed());
  EXPECT_THAT(xml, HasSubstr("tests=\"5\" failures=\"2\" errors=\"1\""));
  EXPECT_THAT(xml, HasSubstr("name=\"d &lt;&amp;&quot;&apos;&gt; | *?\""));
  EXPECT_EQ(xml.find('\x01'), std::string::npos);
  const auto count = [&xml](const std::string& word) {
    std::size_t n = 0;
    for (std::size_t at = xml.find(word); at != std::string::npos; at = xml.find(word, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("<testcase "), 5u);
  EXPECT_EQ(count("</testcase>"), 5u);
  EXPECT_EQ(count("<failure "), 2u);
  EXPECT_EQ(count("<error "), 1u);
}

}  // namespace gate_report_test
}  // namespace placegraph
