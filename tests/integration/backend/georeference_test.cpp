#include <gtest/gtest.h>
#include <placegraph/backend/georeference/georeference.h>

#include "tests/support/data.h"
#include "tests/support/gps_scenario.h"

namespace placegraph {
namespace georeference_test {

using test::GpsScenario;
using test::GpsScenarioOptions;
using test::make_gps_scenario;
using test::position_rmse;

/// Fixes in a dropout's time must be neither used nor invented, gross ones must go.
void expect_sound(const GpsScenario& scenario, const GeoreferenceResult& result) {
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_TRUE(result.unplaced_nodes.empty());
  const double share =
      static_cast<double>(result.fixes_rejected) / static_cast<double>(scenario.input.fixes.size());
  // 5 % are gross; of the others, one in some thousand is that far off by chance.
  EXPECT_NEAR(share, 0.05, 0.02);
  // The noise is stated as it is.
  EXPECT_NEAR(result.accuracy_factor_horizontal, 1, 0.15);
  EXPECT_NEAR(result.accuracy_factor_vertical, 1, 0.15);
}

/// One walk through a dropout is some three independent numbers: five of them, of other seeds, are
/// judged together. `check` looks at each.
template <class Check>
void expect_decimetres(const std::string& folder, GpsScenarioOptions options, Check&& check) {
  double outside = 0, inside = 0;
  const int walks = 5;
  for (options.seed = 1; options.seed <= walks; ++options.seed) {
    const GpsScenario scenario = make_gps_scenario(folder, options);
    const GeoreferenceResult result = georeference(scenario.input, {});
    expect_sound(scenario, result);
    check(result);
    outside += std::pow(position_rmse(scenario, result.graph, false), 2);
    inside += std::pow(position_rmse(scenario, result.graph, true), 2);
  }
  EXPECT_LE(std::sqrt(outside / walks), 0.3);
  EXPECT_LE(std::sqrt(inside / walks), 2.0);
}

TEST(Georeference, HoldsKitti00WithinDecimetresThroughNoiseDropoutsAndGrossErrors) {
  PLACEGRAPH_DATA_OR_SKIP(folder, "kitti_gt/00");
  GpsScenarioOptions options;
  options.dropouts_s = {{100, 200}, {300, 400}};
  expect_decimetres(folder, options, [](const GeoreferenceResult& result) {
    ASSERT_EQ(result.dropouts.size(), 2u);
    EXPECT_NEAR(1e-9 * static_cast<double>(result.dropouts[1].begin_ns), 300, 1);
  });
}

TEST(Georeference, HoldsKitti06ThoughItsPosesLagBehindTheClockOfTheFixes) {
  PLACEGRAPH_DATA_OR_SKIP(folder, "kitti_gt/06");
  GpsScenarioOptions options;
  options.dropouts_s = {{40, 80}};
  expect_decimetres(folder, options, [](const GeoreferenceResult& result) {
    EXPECT_NEAR(result.map_delay_s, 0.118, 4 * result.map_delay_sigma_s);
  });
}

TEST(Georeference, HoldsKitti00WhateverItsOdometryClaims) {
  PLACEGRAPH_DATA_OR_SKIP(folder, "kitti_gt/00");
  GpsScenarioOptions options;
  options.dropouts_s = {{100, 200}};
  GpsScenario scenario = make_gps_scenario(folder, options);
  for (Constraint& constraint : scenario.input.graph.constraints)
    std::get<RelativePoseConstraint>(constraint).information = Information::Identity(6, 6);
  const GeoreferenceResult result = georeference(scenario.input, {});
  expect_sound(scenario, result);
  EXPECT_LT(result.odometry_factor_rotation, 0.01);
  EXPECT_LE(position_rmse(scenario, result.graph, false), 0.3);
  // One walk through one dropout: its posterior has 1.3 m, three times that is next to impossible.
  EXPECT_LE(position_rmse(scenario, result.graph, true), 3.9);
}

TEST(Georeference, FindsTheClockOfKitti06AndHoldsItWithinDecimetres) {
  PLACEGRAPH_DATA_OR_SKIP(folder, "kitti_gt/06");
  GpsScenarioOptions options;
  options.dropouts_s = {{40, 80}};
  options.reference_by_line = true;
  const GpsScenario scenario = make_gps_scenario(folder, options);
  GeoreferenceOptions how;
  how.estimate_clock_offset = true;
  const GeoreferenceResult result = georeference(scenario.input, how);
  expect_sound(scenario, result);
  // times_oxts.txt runs 0.118 s behind times.txt.
  EXPECT_NEAR(result.clock_offset_s, 0.118, 4 * result.clock_offset_sigma_s);
  EXPECT_LT(result.clock_offset_sigma_s, 0.03);
  EXPECT_LE(position_rmse(scenario, result.graph, false), 0.35);
  EXPECT_LE(position_rmse(scenario, result.graph, true), 2.0);
}

TEST(Georeference, FindsTheHorizontalLeverArmOfKitti00AndSaysHowVagueTheVerticalIs) {
  PLACEGRAPH_DATA_OR_SKIP(folder, "kitti_gt/00");
  GpsScenarioOptions options;
  options.reference_by_line = true;
  GpsScenario scenario = make_gps_scenario(folder, options);
  scenario.input.lever_arm.setZero();
  GeoreferenceOptions how;
  how.estimate_lever_arm = how.estimate_clock_offset = true;
  const GeoreferenceResult result = georeference(scenario.input, how);
  expect_sound(scenario, result);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(result.lever_arm[k], options.lever_arm[k],
                4 * std::sqrt(result.lever_arm_covariance(k, k)));
  EXPECT_TRUE(result.lever_arm_observable[0]);  // right
  EXPECT_TRUE(result.lever_arm_observable[2]);  // forward
  // A car hardly rolls or pitches: of the vertical little more is known than the prior's 2 m.
  EXPECT_GT(result.lever_arm_covariance(1, 1), 0.5 * 0.5);
  EXPECT_LT(result.lever_arm_covariance(0, 0), 0.15 * 0.15);
  EXPECT_LT(result.lever_arm_covariance(2, 2), 0.25 * 0.25);
}

}  // namespace georeference_test
}  // namespace placegraph
