#include <gtest/gtest.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/pipeline/loops/loop_gates.h>

#include <numbers>

#include "tests/support/scenes/scene.h"

namespace placegraph {
namespace loop_gates_test {

using test::pose;

// Bounds below are computed by hand from the defaults: 0.015 and 0.03 of lengths, 2 degrees and one
// more per median depth, 0.15 and 0.03 more per median depth for the logarithm of the scale.
const LoopOptions kOptions;
constexpr double kDepth_m = 10;

SE3 ahead(double m) { return pose({0, 0, 0}, {0, 0, m}); }
SE3 aside(double m) { return pose({0, 0, 0}, {m, 0, 0}); }
SE3 rotated(double deg) { return pose({0, deg_to_rad(deg), 0}, {0, 0, 0}); }

Loop loop_of(const Sim3& S_match_query, double sigma = 0.01) {
  Loop loop;
  loop.T_match_query = SE3(S_match_query.rotation(), S_match_query.translation());
  loop.scale_match_query = S_match_query.scale();
  loop.information.diagonal().head<6>().setConstant(1 / (sigma * sigma));
  return loop;
}
Loop loop_of(const SE3& T_match_query, double sigma = 0.01) {
  return loop_of(Sim3(T_match_query), sigma);
}
Sim3 scaled_by(double log_scale) { return Sim3(SO3(), {0, 0, 0}, std::exp(log_scale)); }

TEST(LoopGates, DriftGrowsWithThePathAndTheDistance) {
  const Drift drift = drift_over(20, 4, kDepth_m, kOptions);
  EXPECT_NEAR(drift.angle_rad, deg_to_rad(4.0), 1e-12);
  EXPECT_NEAR(drift.length, 0.015 * 30 + 0.5 * deg_to_rad(4.0) * 4, 1e-12);
  EXPECT_NEAR(drift.log_scale, 0.15 + 0.06, 1e-12);
  EXPECT_EQ(drift_over(1e6, 4, kDepth_m, kOptions).angle_rad, std::numbers::pi);
}

TEST(LoopGates, ReachIsTheLongestBaselineAndTheDrift) {
  // d <= 0.15 * 20 + 0.015 * 20 + 0.5 * 3 deg * d, so d <= 3.389.
  EXPECT_TRUE(within_reach({ahead(3.38), 10}, 20, kDepth_m, kOptions));
  EXPECT_FALSE(within_reach({ahead(3.40), 10}, 20, kDepth_m, kOptions));
  // Without depths only the drift is left: d <= 0.308.
  EXPECT_TRUE(within_reach({ahead(0.30), 10}, 0, kDepth_m, kOptions));
  EXPECT_FALSE(within_reach({ahead(0.32), 10}, 0, kDepth_m, kOptions));
}

TEST(LoopGates, ALoopMayLieWhereOdometryCanHaveDriftedTo) {
  const TrackedMotion odometry{ahead(5), 10};  // up to 0.015 * 20 + 0.5 * 3 deg * 5 = 0.431
  const auto passes = [&](const SE3& off) {
    return within_drift(loop_of(ahead(5) * off), odometry, kDepth_m, false, kOptions);
  };
  EXPECT_TRUE(passes(aside(0.42)));
  EXPECT_FALSE(passes(aside(0.44)));
  EXPECT_TRUE(passes(rotated(2.9)));
  EXPECT_FALSE(passes(rotated(3.1)));
}

TEST(LoopGates, AFreeScaleMayDriftAndOpensTheWayBack) {
  const TrackedMotion odometry{ahead(5), 10};
  const auto passes = [&](double log_scale, const SE3& off, bool free_scale) {
    return within_drift(loop_of(Sim3(ahead(5) * off) * scaled_by(log_scale)), odometry, kDepth_m,
                        free_scale, kOptions);
  };
  for (const double sign : {1, -1}) {  // up to 0.15 + 0.03
    EXPECT_TRUE(passes(0.17 * sign, SE3(), true));
    EXPECT_FALSE(passes(0.19 * sign, SE3(), true));
  }
  // A scale that is 1.105 times another leaves 10 m open by 1.05 m more.
  EXPECT_TRUE(passes(0.1, aside(1.4), true));
  EXPECT_FALSE(passes(0.1, aside(1.5), true));
  EXPECT_FALSE(passes(0.1, aside(1.4), false));
}

TEST(LoopGates, TheMapRefusesWhatItsCovarianceExcludes) {
  const auto passes = [](double off_m, double sigma_map, double sigma_loop, double path_length) {
    PredictedMotion predicted;
    predicted.covariance.diagonal().setConstant(sigma_map * sigma_map);
    predicted.path_length = path_length;
    return within_covariance(loop_of(aside(off_m), sigma_loop), predicted, kDepth_m, kOptions);
  };
  // sqrt(22.46 (0.05^2 + 0.01^2 + 0.01^2)) = 0.246, with 0.05 = 0.015 * 10 / 3.
  EXPECT_TRUE(passes(0.24, 0.01, 0.01, 0));
  EXPECT_FALSE(passes(0.25, 0.01, 0.01, 0));
  // sqrt(22.46 (0.05^2 + 0.1^2 + 0.01^2)) = 0.532, whichever of the two is unsure.
  EXPECT_TRUE(passes(0.52, 0.1, 0.01, 0));
  EXPECT_FALSE(passes(0.54, 0.1, 0.01, 0));
  EXPECT_TRUE(passes(0.52, 0.01, 0.1, 0));
  EXPECT_FALSE(passes(0.54, 0.01, 0.1, 0));
  // sqrt(22.46 (0.2^2 + 0.01^2 + 0.01^2)) = 0.950, with 0.2 = 0.015 * 40 / 3.
  EXPECT_TRUE(passes(0.94, 0.01, 0.01, 30));
  EXPECT_FALSE(passes(0.96, 0.01, 0.01, 30));
}

TEST(LoopGates, TheMapRefusesAScaleOnlyOfALoopThatTellsOne) {
  const auto passes = [](double log_scale, double sigma_map, bool tells) {
    Loop loop = loop_of(scaled_by(log_scale));
    if (tells) loop.information(6, 6) = 1e4;
    PredictedMotion predicted;
    predicted.covariance(6, 6) = sigma_map * sigma_map;
    return within_covariance(loop, predicted, kDepth_m, kOptions);
  };
  EXPECT_TRUE(passes(0.14, 0, true));
  EXPECT_FALSE(passes(0.16, 0, true));
  EXPECT_TRUE(passes(0.44, 0.1, true));  // 0.15 + 3 * 0.1
  EXPECT_FALSE(passes(0.46, 0.1, true));
  EXPECT_TRUE(passes(0.46, 0, false));
}

TEST(LoopGates, ALoopThatLeavesADirectionOpenPasses) {
  Loop loop = loop_of(aside(100));
  EXPECT_FALSE(within_covariance(loop, {}, kDepth_m, kOptions));
  loop.information(0, 0) = 0;
  EXPECT_TRUE(within_covariance(loop, {}, kDepth_m, kOptions));
}

TEST(LoopGates, TwoLoopsAgreeIfOdometryLeadsFromOneToTheOther) {
  const TrackedMotion queries{pose({0, 0.1, 0}, {0.2, 0, 1}), 1},
      matches{pose({0, -0.2, 0}, {0, 0.1, 2}), 1};
  const SE3 T_match_query = pose({0.1, 0.3, 0}, {1, 0.2, 0.5});
  const SE3 T_next = matches.T_a_b.inverse() * T_match_query * queries.T_a_b;
  const auto passes = [&](const Sim3& off) {
    return agree(loop_of(T_match_query), loop_of(Sim3(T_next) * off), queries, matches, kDepth_m);
  };
  EXPECT_TRUE(passes(Sim3(aside(0.35))));  // 0.03 * (10 + 2)
  EXPECT_FALSE(passes(Sim3(aside(0.37))));
  EXPECT_TRUE(passes(Sim3(rotated(1.9))));
  EXPECT_FALSE(passes(Sim3(rotated(2.1))));
  EXPECT_TRUE(passes(scaled_by(-0.14)));
  EXPECT_FALSE(passes(scaled_by(-0.16)));
}

TEST(LoopGates, AgreementIsMeasuredInTheUnitOfTheQuery) {
  // One unit of the query is two of the match: 20 of its units of path are 10.
  const TrackedMotion queries{ahead(1), 1}, matches{ahead(2), 20};
  const Sim3 S_match_query(SO3(), {1, 0, 0}, 2);
  const auto passes = [&](double off) {
    return agree(loop_of(S_match_query), loop_of(S_match_query * Sim3(aside(off))), queries,
                 matches, kDepth_m);
  };
  EXPECT_TRUE(passes(0.62));  // 0.03 * (10 + 1 + 10)
  EXPECT_FALSE(passes(0.64));
}

}  // namespace loop_gates_test
}  // namespace placegraph
