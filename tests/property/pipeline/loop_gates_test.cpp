#include <gtest/gtest.h>
#include <placegraph/pipeline/loops/loop_gates.h>

#include <array>

#include "tests/support/scenes/poses.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace loop_gates_test {

using namespace test;

constexpr int kTrials = 400;

Loop random_loop(Random& random, const SE3& T_match_query) {
  Loop loop;
  loop.T_match_query = T_match_query * uniform_motion(random, 0.4, 0.03);
  for (int i = 0; i < 6; ++i) loop.information(i, i) = random.uniform(10, 1e4);
  return loop;
}

SE3 rigid(const Sim3& S) { return SE3(S.rotation(), S.translation()); }

TEST(LoopGateLaws, TheMapFrameChangesNoDecision) {
  Random random = seeded_random(1);
  int passed = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Sim3 S_map_match(uniform_motion(random, 20, 1)),
        S_map_query = S_map_match * Sim3(uniform_motion(random, 5, 1));
    const Loop loop = random_loop(random, rigid(S_map_match.inverse() * S_map_query));
    const Sim3 S_new_map(uniform_motion(random, 50, 2));
    const auto passes = [&](const Sim3& S_frame_map) {
      PredictedMotion predicted{(S_frame_map * S_map_match).inverse() *
                                (S_frame_map * S_map_query)};
      predicted.covariance.diagonal().head<6>().setConstant(1e-3);
      predicted.path_length = 5;
      return within_covariance(loop, predicted, 10, {});
    };
    passed += passes(Sim3());
    EXPECT_EQ(passes(Sim3()), passes(S_new_map)) << trial;
  }
  EXPECT_GT(passed, kTrials / 10);
  EXPECT_LT(passed, kTrials - kTrials / 10);
}

/// Lengths of everything times `factor`; the information of translations falls with it.
Loop rescaled(Loop loop, double factor) {
  loop.T_match_query = loop.T_match_query.scaled(factor);
  loop.information.topRows<3>() /= factor;
  loop.information.leftCols<3>() /= factor;
  return loop;
}
TrackedMotion rescaled(const TrackedMotion& motion, double factor) {
  return {motion.T_a_b.scaled(factor), factor * motion.path_length};
}

TEST(LoopGateLaws, TheUnitOfLengthChangesNoDecision) {
  Random random = seeded_random(2);
  int passed[4] = {};
  for (int trial = 0; trial < kTrials; ++trial) {
    const TrackedMotion odometry{uniform_motion(random, 3, 0.5), random.uniform(3, 10)},
        queries{uniform_motion(random, 1, 0.1), 1}, matches{uniform_motion(random, 1, 0.1), 1};
    const Loop a = random_loop(random, odometry.T_a_b);
    const Loop b = random_loop(random, matches.T_a_b.inverse() * a.T_match_query * queries.T_a_b);
    const double farthest = random.uniform(5, 30), factor = random.uniform(0.1, 10);
    const auto decisions = [&](double unit) {
      PredictedMotion predicted{Sim3(odometry.T_a_b.scaled(unit))};
      predicted.covariance.diagonal().head<3>().setConstant(1e-3 * unit * unit);
      predicted.path_length = unit * odometry.path_length;
      const double depth = 10 * unit;
      return std::array<bool, 4>{
          within_reach(rescaled(odometry, unit), farthest * unit, depth, {}),
          within_drift(rescaled(a, unit), rescaled(odometry, unit), depth, false, {}),
          within_covariance(rescaled(a, unit), predicted, depth, {}),
          agree(rescaled(a, unit), rescaled(b, unit), rescaled(queries, unit),
                rescaled(matches, unit), depth)};
    };
    const auto before = decisions(1);
    EXPECT_EQ(before, decisions(factor)) << trial << " by " << factor;
    for (std::size_t i = 0; i < 4; ++i) passed[i] += before[i];
  }
  for (const int count : passed) {  // both answers are met
    EXPECT_GT(count, kTrials / 20);
    EXPECT_LT(count, kTrials - kTrials / 20);
  }
}

}  // namespace loop_gates_test
}  // namespace placegraph
