#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/gate/gate.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>

#include "tests/unit/eval/gate/gate_worlds.h"

namespace placegraph {
namespace gate_test {

using namespace gate_worlds;
using testing::HasSubstr;

GateFigure judged(const FigureRecord& before, const FigureRecord& after,
                  const std::string& rule) {
  Record a = record_of({}), b = record_of({});
  a.sequences[0].figures = {before};
  b.sequences[0].figures = {after};
  const GateResult result = judge(a, b, parse_rules("* | * | " + rule, "rules"));
  EXPECT_EQ(result.figures.size(), 1u);
  return result.figures.front();
}

FigureRecord number(std::optional<double> value, const std::string& text = "") {
  FigureRecord figure;
  figure.key = "x";
  figure.values = {value};
  figure.text = text;
  return figure;
}
FigureRecord of_whole(double value, double whole) {
  FigureRecord figure = number(value);
  figure.whole = whole;
  return figure;
}
FigureRecord verdict(bool yes) {
  FigureRecord figure = number(yes ? 1 : 0);
  figure.verdict = true;
  return figure;
}

TEST(Gate, TolerancesAreTheLargerOfTheTwo) {
  const auto standing = [](double before, double after, const char* rule) {
    return judged(number(before), number(after), rule).standing;
  };
  using enum Standing;
  EXPECT_EQ(standing(1.0, 1.0, "lower 2 %"), kSame);
  EXPECT_EQ(standing(1.0, 0.97, "lower 2 %"), kImproved);
  EXPECT_EQ(standing(1.0, 1.02, "lower 2 %"), kWithin);
  EXPECT_EQ(standing(1.0, 1.0201, "lower 2 %"), kRegressed);
  EXPECT_EQ(standing(1.0, 1.0201, "lower 2 % 0.03"), kWithin);
  EXPECT_EQ(standing(1.0, 1.0201, "lower 2 % floor 0.03"), kWithin);
  EXPECT_EQ(standing(0.0, 0.1, "lower 2 %"), kRegressed);
  EXPECT_EQ(standing(-1.0, -1.5, "lower 2 %"), kImproved);
  EXPECT_EQ(standing(-1.0, -0.5, "lower 2 %"), kRegressed);
  EXPECT_EQ(standing(-1.0, 0.5, "zero 2 %"), kImproved);
  EXPECT_EQ(standing(-1.0, 1.5, "zero 2 %"), kRegressed);
  EXPECT_EQ(standing(0.1, 0.098, "higher 1 % 0.002"), kWithin);
  EXPECT_EQ(standing(0.1, 0.0979, "higher 1 % 0.002"), kRegressed);
  EXPECT_EQ(standing(0.9, 0.92, "higher 1 % 0.002"), kImproved);
  EXPECT_EQ(standing(100, 101, "equal 0.1 %"), kRegressed);
  EXPECT_EQ(standing(100, 99, "equal 0.1 %"), kRegressed);
  EXPECT_EQ(standing(100, 100.1, "equal 0.1 %"), kWithin);
  EXPECT_EQ(standing(1, 9, "info"), kReported);
}

TEST(Gate, WhatIsLostIsWorseUnderEveryRuleButIgnore) {
  for (const char* rule : {"lower 50 %", "higher 50 %", "equal", "info", "time", "significant",
                           "significant else worse 50 %", "significant over sequences"}) {
    const GateFigure lost = judged(number(1.5), number({}), rule);
    EXPECT_EQ(lost.standing, Standing::kRegressed) << rule;
    EXPECT_EQ(judged(number({}), number(1.5), rule).standing, Standing::kNew) << rule;
    EXPECT_EQ(judged(number({}), number({}), rule).standing, Standing::kSame) << rule;
    EXPECT_EQ(judged(verdict(true), verdict(false), rule).standing, Standing::kRegressed) << rule;
    EXPECT_EQ(judged(verdict(false), verdict(true), rule).standing, Standing::kImproved) << rule;
    EXPECT_EQ(judged(verdict(true), verdict(true), rule).standing, Standing::kSame) << rule;
    const Record before = record_of({{"a", {1.0}}, {"b", {1.0}}});
    const GateRules rules = parse_rules(std::string("* | a | ignore\n* | * | ") + rule, "r");
    EXPECT_EQ(judge(before, record_of({{"a", {1.0}}}), rules).exit_code(), 1) << rule;
    Record elsewhere = before;
    elsewhere.sequences[0].name = "01";
    EXPECT_EQ(judge(before, elsewhere, rules).exit_code(), 1) << rule;
  }
  const GateRules rules = parse_rules("* | b | ignore\n* | a | worse 1 %", "r");
  const Record before = record_of({{"a", {1.0}}, {"b", {1.0}}});
  EXPECT_EQ(judge(before, record_of({{"a", {1.0}}}), rules).exit_code(), 0);
}

TEST(Gate, CountsAreOutOfAWhole) {
  EXPECT_EQ(judged(of_whole(3, 3), of_whole(2, 2), "higher 0").standing, Standing::kRegressed);
  EXPECT_EQ(judged(of_whole(22, 24), of_whole(21, 24), "higher 0").standing,
            Standing::kRegressed);
  EXPECT_EQ(judged(of_whole(22, 24), of_whole(23, 24), "higher 0").standing, Standing::kImproved);
  EXPECT_EQ(judged(of_whole(30, 30), of_whole(32, 32), "higher 1 % whole").standing,
            Standing::kWithin);
  EXPECT_EQ(judged(of_whole(30, 30), of_whole(30, 32), "higher 1 % whole").standing,
            Standing::kRegressed);
  EXPECT_EQ(judged(of_whole(30, 30), of_whole(30, 32), "higher 1 % whole").after_text, "30 of 32");
}

TEST(Gate, AFigureOfAnotherFormIsAnotherFigure) {
  EXPECT_EQ(judged(number(5, "<= {}"), number(5, ">= {}"), "equal").standing,
            Standing::kRegressed);
  EXPECT_EQ(judged(number(5, "<= {}"), number(5, ">= {}"), "equal").after_text, ">= 5");
  EXPECT_EQ(judged(number({}, "chordal"), number({}, "file"), "equal").standing,
            Standing::kRegressed);
  EXPECT_EQ(judged(number({}, "chordal"), number({}, "file"), "info").standing, Standing::kReported);
  EXPECT_EQ(judged(number({}, "chordal"), number({}, "chordal"), "equal").standing,
            Standing::kSame);
}

TEST(Gate, AFailedRunIsNeverLeftOut) {
  const Record before = record_of({{"ate_rmse_m", {1.0, 1.1, 0.9, 1.0, 1.05, 0.95}}});
  Record after = record_of({{"ate_rmse_m", {1.0, 1.1, {}, 1.0, 1.05, 0.95}}});
  after.sequences[0].failures = {"run 3: too few pairs"};
  const GateResult result = judge(before, after);
  EXPECT_EQ(result.exit_code(), 1);
  EXPECT_EQ(result.figures[0].reason, "1 of 6 runs have no figure: run 3: too few pairs");
  EXPECT_EQ(judge(after, after).exit_code(), 0);
  EXPECT_EQ(judge(after, before).exit_code(), 0);
}

TEST(Gate, AnotherTruthOrOtherOptionsCannotBeJudged) {
  Record before = record_of({{"a", {1.0}}}), after = record_of({{"a", {9.0}}});
  before.sequences[0].truth = {"01", 10, 5};
  after.sequences[0].truth = {"02", 10, 5};
  EXPECT_EQ(judge(before, after).exit_code(), 2);
  EXPECT_THAT(judge(before, after).sentence, HasSubstr("the truth is another one"));
  after.sequences[0].truth = before.sequences[0].truth;
  EXPECT_EQ(judge(before, after).exit_code(), 1);
  before.sequences[0].options = {{"align", "se3"}};
  after.sequences[0].options = {{"align", "sim3"}};
  EXPECT_EQ(judge(before, after).exit_code(), 2);
  after.sequences[0].options.clear();
  after.sequences[0].figures[0].values = {std::nullopt};  // no run has a result
  EXPECT_EQ(judge(before, after).exit_code(), 1);
  EXPECT_EQ(judge(Record(), Record()).exit_code(), 2);
}

TEST(Gate, ASignificanceOfOneRunCannotBeJudgedAndSaysHowManyItNeeds) {
  const GateRules strict = parse_rules("* | * | significant", "r");
  const GateResult one = judge(record_of({{"a", {1.0}}}), record_of({{"a", {1.2}}}), strict);
  EXPECT_EQ(one.exit_code(), 2);
  EXPECT_EQ(one.figures[0].runs_needed, 5);
  EXPECT_THAT(one.figures[0].reason, HasSubstr("5 runs of each are needed"));
  const Record many = record_of({{"a", {1.0, 1.3, 0.8, 1.1, 0.9, 1.2}}});
  const GateResult pilot = judge(many, record_of({{"a", {1.2}}}), strict);
  EXPECT_EQ(pilot.exit_code(), 2);
  EXPECT_GT(pilot.figures[0].runs_needed, 10);
  const GateRules lenient = parse_rules("* | * | significant else worse 5 %", "r");
  EXPECT_EQ(judge(many, record_of({{"a", {1.2}}}), lenient).exit_code(), 1);
  EXPECT_EQ(judge(many, record_of({{"a", {1.05}}}), lenient).exit_code(), 0);
}

TEST(Gate, WhoAsksForAnEffectIsToldWhenTheRunsCannotFindIt) {
  const Record many = record_of({{"a", {1.0, 1.3, 0.8, 1.1, 0.9, 1.2}}});
  const GateResult result = judge(many, many, parse_rules("* | * | significant 10 %", "r"));
  EXPECT_EQ(result.exit_code(), 2);
  EXPECT_THAT(result.figures[0].reason, HasSubstr("10 % worse would be found with"));
  EXPECT_EQ(judge(many, many, parse_rules("* | * | significant 200 %", "r")).exit_code(), 0);
}

TEST(Gate, RunsThatRepeatOneComputationHaveNoScatter) {
  const Record before = record_of({{"a", Values(5, 1.0)}});
  const GateRules rules = parse_rules("* | * | significant else worse 5 %", "r");
  EXPECT_EQ(judge(before, record_of({{"a", Values(5, 1.04)}}), rules).exit_code(), 0);
  EXPECT_EQ(judge(before, record_of({{"a", Values(5, 1.06)}}), rules).exit_code(), 1);
  const GateRules strict = parse_rules("* | * | significant", "r");
  EXPECT_EQ(judge(before, record_of({{"a", Values(5, 1.001)}}), strict).exit_code(), 1);
}

TEST(Gate, NoDifferenceBelowTheNoiseOfTheTruthCounts) {
  const Values low = {1.00, 1.01, 0.99, 1.02, 0.98, 1.0}, high = {1.10, 1.11, 1.09, 1.12, 1.08, 1.1};
  Record before = record_of({{"a", low}}), after = record_of({{"a", high}});
  const GateRules rules = parse_rules("* | * | significant", "r");
  EXPECT_EQ(judge(before, after, rules).exit_code(), 1);
  after.sequences[0].figures[0].noise_floor = 0.2;
  const GateResult within = judge(before, after, rules);
  EXPECT_EQ(within.exit_code(), 0);
  EXPECT_THAT(within.figures[0].reason, HasSubstr("within the noise of the truth, 0.2"));
  after.sequences[0].figures[0].noise_floor = 0;
  const GateRules floor = parse_rules("* | * | significant floor 0.2", "r");
  EXPECT_EQ(judge(before, after, floor).exit_code(), 0);
  // By a tolerance, too.
  after.sequences[0].figures[0].noise_floor = 0.2;
  const GateResult tolerated = judge(before, after, parse_rules("* | * | worse 5 %", "r"));
  EXPECT_EQ(tolerated.exit_code(), 0);
  EXPECT_EQ(tolerated.figures[0].reason, "the difference is within the noise of the truth, 0.2");
}

TEST(Gate, SequencesAreTestedInPairs) {
  Record before, after, two;
  for (int i = 0; i < 8; ++i) {
    // Sequences differ by far more than the systems.
    const double error = std::pow(2.0, i);
    Record one = record_of({{"a", {error}}}), worse = record_of({{"a", {error * (1.1 + .01 * i)}}});
    one.sequences[0].name = worse.sequences[0].name = std::to_string(i);
    before.sequences.push_back(one.sequences[0]);
    after.sequences.push_back(worse.sequences[0]);
    if (i < 2) two.sequences.push_back(worse.sequences[0]);
  }
  const GateRules rules = parse_rules("* | * | significant over sequences", "r");
  const GateResult result = judge(before, after, rules);
  EXPECT_EQ(result.exit_code(), 1);
  EXPECT_EQ(result.figures[0].sequence, "(all 8)");
  EXPECT_EQ(judge(before, before, rules).exit_code(), 0);
  EXPECT_EQ(judge(after, before, rules).exit_code(), 0);
  EXPECT_EQ(judge(two, two, rules).exit_code(), 2);
}

TEST(Gate, RulesMayAskForFiguresAndKnowOldNames) {
  const Record before = record_of({{"ate", {1.0}}}), after = record_of({{"ate_rmse_m", {1.0}}});
  EXPECT_EQ(judge(before, after, parse_rules("* | * | worse 1 %", "r")).exit_code(), 1);
  EXPECT_EQ(judge(before, after, parse_rules("rename * | ate -> ate_rmse_m\n* | * | worse", "r"))
                .exit_code(),
            0);
  EXPECT_EQ(judge(before, before, parse_rules("must 0* | ate\n* | * | worse", "r")).exit_code(), 0);
  EXPECT_EQ(judge(before, before, parse_rules("must 05 | ate\n* | * | worse", "r")).exit_code(), 1);
}

TEST(Gate, TimesAreToldByTheirReferenceRuns) {
  Record before = record_of({{"CPU", {1.0}}}), after = record_of({{"CPU", {2.2}}});
  before.sequences[0].reference_s = 0.2;
  after.sequences[0].reference_s = 0.4;
  const GateResult result = judge(before, after, parse_rules("* | * | time", "r"));
  EXPECT_EQ(result.exit_code(), 0);
  EXPECT_EQ(result.figures[0].change, "+120 % (+10 % by the reference runs)");
}

Record shuffled(Record record, Random& random) {
  const auto shuffle = [&random](auto& list) {
    for (std::size_t i = list.size(); i > 1; --i)
      std::swap(list[i - 1], list[static_cast<std::size_t>(random.index(static_cast<int>(i)))]);
  };
  shuffle(record.sequences);
  for (SequenceRecord& sequence : record.sequences) {
    shuffle(sequence.figures);
    for (FigureRecord& figure : sequence.figures) shuffle(figure.values);
  }
  return record;
}

std::string all_of(const GateResult& result) {
  std::string text = result.sentence;
  for (const GateFigure& figure : result.figures)
    text += "\n" + figure.sequence + " " + figure.figure + " " + to_string(figure.standing) + " " +
            figure.change + " " + figure.reason;
  return text;
}

TEST(Gate, OrdersOfRunsFiguresAndSequencesDoNotMatter) {
  Random random(3);
  const GateRules rules = parse_rules(
      "* | a | worse 5 %\n* | b | significant\n* | c | significant over sequences\n"
      "* | * | significant 10 % else 5 %",
      "r");
  for (int world = 0; world < 100; ++world) {
    const auto draw = [&random, sequences = 1 + random.index(7)](int runs) {
      Record record;
      for (int s = 0; s < sequences; ++s) {
        Record one = record_of({{"a", {}}, {"b", {}}, {"c", {}}, {"d", {}}});
        one.sequences[0].name = std::to_string(s);
        for (FigureRecord& figure : one.sequences[0].figures)
          for (int run = 0; run < runs; ++run)
            figure.values.emplace_back(std::exp(random.normal(0, 0.3)));
        record.sequences.push_back(one.sequences[0]);
      }
      return record;
    };
    const Record before = draw(1 + random.index(12)), after = draw(1 + random.index(12));
    const std::string told = all_of(judge(before, after, rules));
    for (int order = 0; order < 3; ++order)
      ASSERT_EQ(all_of(judge(shuffled(before, random), shuffled(after, random), rules)), told);
  }
}

TEST(Gate, RefusesLevelsThatAreNoProbabilities) {
  const Record record = record_of({{"a", {1.0}}});
  GateOptions options;
  options.level = 1;
  EXPECT_THROW(static_cast<void>(judge(record, record, default_rules(), options)), ArgumentError);
}

}  // namespace gate_test
}  // namespace placegraph
