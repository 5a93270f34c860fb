#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/eval/trajectory/figure_intervals.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/trajectories.h"

namespace placegraph {
namespace figure_intervals_test {

using testing::ElementsAre;

const Trajectory& truth() {
  static const Trajectory drive = test::winding_drive(900);
  return drive;
}

EvaluationResult judged(double sigma_m, int seed, const std::string& name) {
  Random random(static_cast<std::uint64_t>(seed));
  EvaluationOptions options;
  options.segments.lengths_m = {20, 40};
  options.relative.deltas = {parse_delta("10f")};
  return evaluate(truth(), test::drifting(truth(), sigma_m, 1e-4, random), options, name);
}

template <class Figures>
std::vector<std::string> keys_of(const Figures& figures) {
  std::vector<std::string> keys;
  for (const auto& each : figures) keys.push_back(each.key);
  return keys;
}

TEST(IntervalsOfDrive, AreOfRelativeFiguresAndHoldThem) {
  const std::vector<FigureInterval> intervals = intervals_of_drive(judged(0.02, 1, "a"));
  EXPECT_THAT(keys_of(intervals),
              ElementsAre("ate_rmse_m", "t_rel_percent", "r_rel_deg_per_100m", "rpe_trans_m",
                          "rpe_rot_deg", "rpe_10f_trans_m", "rpe_10f_rot_deg"));
  EXPECT_EQ(intervals[0].interval.outcome.reason, "one run");
  EXPECT_TRUE(to_text(intervals[0].interval).ends_with(", one run: no interval"));
  for (std::size_t i = 1; i < intervals.size(); ++i) {
    const ConfidenceInterval& interval = intervals[i].interval;
    ASSERT_TRUE(interval.outcome) << intervals[i].key << ": " << interval.outcome.reason;
    EXPECT_LT(interval.low, interval.estimate);
    EXPECT_GT(interval.high, interval.estimate);
  }
  EXPECT_NEAR(intervals[3].interval.estimate, std::sqrt(3.0) * 0.02, 0.002);
}

TEST(IntervalsOfRepeatedRuns, NeedFiveRunsThatAllHaveFigures) {
  std::vector<EvaluationResult> runs;
  for (int seed = 0; seed < 6; ++seed) runs.push_back(judged(0.02, seed, "run"));
  const auto ate_of = [](const std::vector<FigureInterval>& intervals) {
    return std::ranges::find(intervals, "ate_rmse_m", &FigureInterval::key)->interval;
  };
  EXPECT_TRUE(ate_of(intervals_of_repeated_runs(runs)).outcome);
  runs.push_back({});
  runs.back().outcome = Outcome::failure(Outcome::Code::kTooFewData, "lost");
  EXPECT_EQ(ate_of(intervals_of_repeated_runs(runs)).outcome.reason,
            "1 of 7 runs have no such figure");
  runs.resize(4);
  EXPECT_EQ(ate_of(intervals_of_repeated_runs(runs)).outcome.code, Outcome::Code::kTooFewData);
  EXPECT_TRUE(intervals_of_repeated_runs({}).empty());
}

TEST(CompareWithFirst, FindsTheWorseEstimateAndNoneOfEqualOnes) {
  const std::vector<EvaluationResult> results = {judged(0.02, 1, "A"), judged(0.02, 2, "B"),
                                                 judged(0.04, 3, "C")};
  const auto comparisons = compare_with_first(results);
  ASSERT_EQ(comparisons.size(), 2u);
  const auto of = [](const std::vector<FigureComparison>& figures, const std::string& key) {
    return std::ranges::find(figures, key, &FigureComparison::key)->comparison;
  };
  EXPECT_EQ(of(comparisons[0], "rpe_trans_m").difference, Difference::kNone);
  const Comparison worse = of(comparisons[1], "rpe_trans_m");
  EXPECT_EQ(worse.difference, Difference::kWorse);
  EXPECT_NEAR(worse.ratio.estimate, 2, 0.1);
  EXPECT_THAT(worse.sentence, testing::StartsWith("C is "));
  EXPECT_THROW((void)compare_with_first({}), ArgumentError);
  const auto json = nlohmann::json::parse(to_json(comparisons[1]));
  EXPECT_EQ(json.at("rpe_trans_m").at("difference"), "worse");
}

TEST(NoiseFloors, AreWhatBothEndsOfAStepAdd) {
  const EvaluationResult result = judged(0.02, 1, "A");
  const TruthNoise noise = TruthNoise::white(0.1, 0.01);
  const auto floors = noise_floors(result, noise);
  const double m = std::sqrt(3.0) * 0.1, deg = std::sqrt(3.0) * rad_to_deg(0.01);
  EXPECT_NEAR(floors.at("ate_rmse_m"), m, 1e-12);
  EXPECT_NEAR(floors.at("are_rmse_deg"), deg, 1e-12);
  EXPECT_NEAR(floors.at("rpe_trans_m"), std::sqrt(2.0) * m, 1e-12);
  EXPECT_NEAR(floors.at("rpe_10f_rot_deg"), std::sqrt(2.0) * deg, 1e-12);
  // Segments of 20 and 40 m: between 2.5 and 5 % for each metre.
  EXPECT_GT(floors.at("t_rel_percent"), 2.5 * std::sqrt(2.0) * m);
  EXPECT_LT(floors.at("t_rel_percent"), 5 * std::sqrt(2.0) * m);
  TruthNoise unknown;
  unknown.outcome = Outcome::failure(Outcome::Code::kTooFewData, "short");
  EXPECT_TRUE(noise_floors(result, unknown).empty());
}

TEST(CompareEstimates, DoesNotCountWhatIsWithinTheNoiseOfTheTruth) {
  const auto figures = compare_estimates(judged(0.02, 1, "A"), judged(0.04, 3, "B"),
                                         TruthNoise::white(0.5, 0.5));
  for (const FigureComparison& each : figures)
    EXPECT_NE(each.comparison.difference, Difference::kWorse) << each.key;
}

}  // namespace figure_intervals_test
}  // namespace placegraph
