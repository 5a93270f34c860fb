#include <gtest/gtest.h>
#include <placegraph/eval/uncertainty/run_interval.h>
#include <placegraph/graph/core/error.h>

#include <limits>

#include "tests/support/message_of.h"

namespace placegraph {
namespace run_interval_test {

TEST(RunInterval, OfFiveRunsIsTheOneComputedByHand) {
  // Mean 3, deviation sqrt(2.5); t = 2.7764 of four degrees of freedom:
  // 3 exp(-+ 2.7764 sqrt(2.5) / 3 / sqrt(5)).
  const ConfidenceInterval interval = interval_of_runs({4, 2, 5, 1, 3});
  ASSERT_TRUE(interval.outcome);
  EXPECT_NEAR(interval.estimate, 3, 1e-12);
  EXPECT_NEAR(interval.low, 1.55923903, 1e-7);
  EXPECT_NEAR(interval.high, 5.77204638, 1e-7);
  EXPECT_EQ(interval.degrees_freedom, 4);
  EXPECT_EQ(to_text(interval), "3, 95 % interval 1.559 to 5.772 (repeated runs)");
}

TEST(RunInterval, IsWiderAtAHigherLevelAndScalesWithItsUnit) {
  const ConfidenceInterval base = interval_of_runs({4, 2, 5, 1, 3});
  EXPECT_GT(interval_of_runs({4, 2, 5, 1, 3}, 0.99).high, base.high);
  EXPECT_NEAR(interval_of_runs({40, 20, 50, 10, 30}).low, 10 * base.low, 1e-9);
}

TEST(RunInterval, IsNoneOfFewerThanFiveRuns) {
  const ConfidenceInterval one = interval_of_runs({0.7}), three = interval_of_runs({0.7, 0.8, 0.9});
  EXPECT_EQ(one.outcome.code, Outcome::Code::kTooFewData);
  EXPECT_EQ(one.outcome.reason, "1 run: 5 are needed");
  EXPECT_EQ(three.outcome.reason, "3 runs: 5 are needed");
  EXPECT_NEAR(three.estimate, 0.8, 1e-12);
}

TEST(RunInterval, IsNoneOfRunsThatRepeatOneComputation) {
  const ConfidenceInterval interval = interval_of_runs({0.7, 0.7, 0.7, 0.7, 0.7, 0.7});
  EXPECT_EQ(interval.outcome.code, Outcome::Code::kDegenerate);
  EXPECT_EQ(interval.outcome.reason, "all 6 runs are equal");
}

TEST(RunInterval, RefusesFiguresThatAreNoErrors) {
  EXPECT_THROW((void)interval_of_runs({}), ArgumentError);
  EXPECT_THROW((void)interval_of_runs({1, 2, 3, 4, std::numeric_limits<double>::infinity()}),
               ArgumentError);
  EXPECT_EQ(test::message_of<ArgumentError>([] { (void)interval_of_runs({1, 2, -3, 4, 5}); }),
            "the figure of a run is -3, not a number of 0 or more");
  EXPECT_THROW((void)interval_of_runs({1, 2, 3, 4, 5}, 0), ArgumentError);
}

TEST(RunsNeeded, AreThoseOfTheUpperLimitOfTheScatter) {
  // Scatter 0.0790569, its limit sqrt(4 / 1.64878) times as large: 0.123138. With 22 runs of each t
  // of 42 degrees of freedom is 1.68195 (0.95) and 0.85036 (0.8), log 1.1 = 0.0953102:
  // 2 (0.123138 * 2.53231 / 0.0953102)^2 = 21.41; with 21 runs it is 21.45.
  const RunsNeeded needed = runs_needed({0.9, 1.1, 0.95, 1.05, 1});
  ASSERT_TRUE(needed.outcome);
  EXPECT_EQ(needed.runs, 22);
}

TEST(RunsNeeded, AreMoreForSmallerEffectsMorePowerAndRarerAlarms) {
  const std::vector<double> baseline = {0.9, 1.1, 0.95, 1.05, 1};
  const int base = runs_needed(baseline).runs;
  EXPECT_GT(runs_needed(baseline, {.worse = 0.05}).runs, base);
  EXPECT_GT(runs_needed(baseline, {.power = 0.9}).runs, base);
  EXPECT_GT(runs_needed(baseline, {.level = 0.01}).runs, base);
}

TEST(RunsNeeded, AreFiveOfRunsWithoutScatterAndUnknownOfFewRuns) {
  EXPECT_EQ(runs_needed({2, 2, 2, 2, 2}).runs, kFewestRuns);
  EXPECT_EQ(runs_needed({1, 2}).outcome.reason, "2 runs: 5 are needed");
  EXPECT_THROW((void)runs_needed({1, 2, 3, 4, 5}, {.worse = 0}), ArgumentError);
  EXPECT_THROW((void)runs_needed({1, 2, 3, 4, 5}, {.power = 1}), ArgumentError);
  EXPECT_THROW((void)runs_needed({1, 2, 3, 4, 5}, {.level = 0}), ArgumentError);
}

}  // namespace run_interval_test
}  // namespace placegraph
