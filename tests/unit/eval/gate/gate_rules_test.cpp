#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/gate/gate_rules.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/message_of.h"

namespace placegraph {
namespace gate_rules_test {

using test::message_of;
using testing::HasSubstr;

GateRule rule(const std::string& text) {
  return parse_rules("* | * | " + text, "rules").rule_of("a", "b");
}

TEST(GateRules, PatternsStandForAnything) {
  for (const auto& [pattern, name, wanted] : std::vector<std::tuple<const char*, const char*, bool>>{
           {"*", "", true}, {"*", "a b", true}, {"a*", "ab", true}, {"a*", "ba", false},
           {"*a", "ba", true}, {"*a*", "bab", true}, {"a*b*c", "aXbYc", true},
           {"a*b*c", "aXcYb", false}, {"ab", "ab", true}, {"ab", "abc", false}, {"", "", true},
           {"a*a", "a", false}, {"[ms]*", "[ms] x", true}, {"*.*", "a.b", true}})
    EXPECT_EQ(fits_pattern(pattern, name), wanted) << pattern << " " << name;
}

TEST(GateRules, TheFirstLineThatFitsDecides) {
  const GateRules rules = parse_rules(
      "# a comment\n\n0* | ate* | worse 2 %\n* | ate_max_m | info\r\n* | * | worse 5 % 0.1\n", "r");
  EXPECT_EQ(rules.rule_of("00", "ate_max_m").relative, 0.02);
  EXPECT_EQ(rules.rule_of("town", "ate_max_m").kind, GateRule::Kind::kInfo);
  EXPECT_EQ(rules.rule_of("town", "x").absolute, 0.1);
  const GateRule strict = GateRules().rule_of("town", "x");
  EXPECT_EQ(strict.kind, GateRule::Kind::kTolerance);
  EXPECT_EQ(strict.relative + strict.absolute, 0);
}

TEST(GateRules, ReadsEveryWord) {
  EXPECT_FALSE(rule("worse 2 %").better.has_value());
  EXPECT_EQ(rule("lower 2 % 0.001").better, Better::kSmaller);
  EXPECT_EQ(rule("lower 2 %, 0.001").absolute, 0.001);
  EXPECT_EQ(rule("higher 0.5").better, Better::kLarger);
  EXPECT_EQ(rule("zero 1e-3").better, Better::kNearerZero);
  EXPECT_EQ(rule("equal").better, Better::kEqual);
  EXPECT_TRUE(rule("higher 2 % whole").whole_may_change);
  EXPECT_EQ(rule("worse 2 % floor 0.01").floor, 0.01);
  EXPECT_EQ(rule("time").kind, GateRule::Kind::kTime);
  EXPECT_EQ(rule("ignore").kind, GateRule::Kind::kIgnore);
  const GateRule plain = rule("significant");
  EXPECT_EQ(plain.kind, GateRule::Kind::kSignificant);
  EXPECT_FALSE(plain.otherwise);
  EXPECT_EQ(plain.find, 0);
  const GateRule full = rule("significant 15 % else worse 5 % 0.2 floor 0.1");
  EXPECT_EQ(full.find, 0.15);
  EXPECT_TRUE(full.otherwise);
  EXPECT_EQ(full.relative, 0.05);
  EXPECT_EQ(full.absolute, 0.2);
  EXPECT_EQ(full.floor, 0.1);
  EXPECT_TRUE(rule("significant over sequences").over_sequences);
  EXPECT_EQ(full.text, "significant 15 % else worse 5 % 0.2 floor 0.1");
}

TEST(GateRules, NamesTheLineThatIsNoRule) {
  for (const char* line :
       {"a | b", "a | b | worse 2 % | c", "a | | worse", "a | b | less 2 %", "a | b | worse x %",
        "a | b | worse -2 %", "a | b | worse nan", "a | b | worse inf", "a | b | info 3",
        "a | b | significant 5", "a | b | significant 0 %", "a | b | significant over", "a | b |",
        "a | b | worse floor", "a | b | worse % 2", "must a", "must a | b | c", "rename a b",
        "rename a | b | c -> d", "rename a -> "})
    EXPECT_THAT(message_of<FileError>(
                    [&] { static_cast<void>(parse_rules(std::string("\n") + line, "r.txt")); }),
                testing::StartsWith("r.txt:2: "))
        << line;
}

TEST(GateRules, RenamesAreOfSequencesOrOfFigures) {
  const GateRules rules = parse_rules(
      "rename town -> city\nrename old* -> new*\nrename gone -> (gone)\n"
      "rename * | ate -> ate_rmse_m\nrename city | x*y* -> y*x*\nrename * | lost -> (gone)\n",
      "r");
  EXPECT_EQ(rules.sequence_now("town"), "city");
  EXPECT_EQ(rules.sequence_now("old 7"), "new 7");
  EXPECT_EQ(rules.sequence_now("other"), "other");
  EXPECT_EQ(rules.sequence_now("gone"), std::nullopt);
  EXPECT_EQ(rules.figure_now("a", "ate"), "ate_rmse_m");
  EXPECT_EQ(rules.figure_now("city", "x1y2"), "y1x2");
  EXPECT_EQ(rules.figure_now("a", "x1y2"), "x1y2");
  EXPECT_EQ(rules.figure_now("a", "lost"), std::nullopt);
}

TEST(GateRules, WithoutAnyTheMainFiguresAreJudged) {
  const GateRules& rules = default_rules();
  EXPECT_EQ(rules.rule_of("00", "ate_rmse_m").kind, GateRule::Kind::kSignificant);
  EXPECT_EQ(rules.rule_of("00", "t_rel_percent").kind, GateRule::Kind::kSignificant);
  EXPECT_EQ(rules.rule_of("00", "ate_max_m").kind, GateRule::Kind::kInfo);
  EXPECT_EQ(rules.rule_of("00", "coverage").absolute, 0.01);
  EXPECT_EQ(rules.rule_of("a", "a figure of another kind").kind, GateRule::Kind::kSignificant);
}

}  // namespace gate_rules_test
}  // namespace placegraph
