#include <gtest/gtest.h>
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>

#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace window_motion_test {

using test::angle_rad;
using test::distance_m;

SE3 step() { return SE3(SO3::exp({0.01, 0.03, -0.02}), Eigen::Vector3d(0.05, -0.02, 1)); }

Matrix6d information_of_step() {
  Vector6d sigmas;
  sigmas << 0.02, 0.03, 0.05, 0.001, 0.002, 0.003;
  return sigmas.cwiseAbs2().cwiseInverse().asDiagonal();
}

SlidingWindow chain(int keyframes, const SlidingWindowOptions& options, double start_off_m) {
  SlidingWindow window(options, test::window_camera());
  SE3 T_map_cam;
  for (int k = 0; k < keyframes; ++k) {
    window.add_keyframe(KeyframeId(k),
                        T_map_cam * SE3(SO3(), Eigen::Vector3d(k > 0 ? start_off_m : 0, 0, 0)));
    if (k > 0)
      add_motion(window, {KeyframeId(k - 1), KeyframeId(k), step(), information_of_step()});
    T_map_cam = T_map_cam * step();
  }
  return window;
}

TEST(WindowMotion, KeyframesWithoutLandmarksGoWhereTheirMotionsLead) {
  SlidingWindow window = chain(4, {}, 0.3);
  const WindowSummary summary = window.optimize();
  ASSERT_TRUE(summary.outcome) << summary.outcome.reason;
  SE3 truth;
  for (int k = 0; k < 4; ++k) {
    EXPECT_LT(distance_m(window.pose(KeyframeId(k)), truth), 1e-9);
    EXPECT_LT(angle_rad(window.pose(KeyframeId(k)), truth), 1e-9);
    truth = truth * step();
  }
  EXPECT_TRUE(relative_information(window, KeyframeId(1), KeyframeId(2))
                  .isApprox(information_of_step(), 1e-6));
  EXPECT_TRUE(relative_covariance(window, KeyframeId(0), KeyframeId(3)).has_value());
}

TEST(WindowMotion, TwoOfOneStepMeetInTheMiddle) {
  SlidingWindowOptions options;
  options.max_iterations = 100;
  options.relative_decrease = 1e-16;
  SlidingWindow window = chain(2, options, 0);
  const Vector6d off = (Vector6d() << 0.02, 0, 0.04, 0, 0, 0).finished();
  add_motion(window, {KeyframeId(0), KeyframeId(1), step().plus(off), information_of_step()});
  ASSERT_TRUE(window.optimize().outcome);
  EXPECT_LT(distance_m(window.pose(KeyframeId(1)), step().plus(0.5 * off)), 1e-8);
  EXPECT_TRUE(relative_information(window, KeyframeId(0), KeyframeId(1))
                  .isApprox(2 * information_of_step(), 1e-3));
}

TEST(WindowMotion, GoesIntoThePriorWithTheKeyframeThatLeaves) {
  for (const bool hold_oldest : {false, true}) {
    SlidingWindowOptions options;
    options.max_keyframes = 3;
    options.hold_oldest = hold_oldest;
    SlidingWindow window = chain(5, options, 0);
    // A loop over the leaving keyframe: what it says of 1 and 2 must stay.
    add_motion(window, {KeyframeId(0), KeyframeId(2), step() * step(), information_of_step()});
    SlidingWindow batch = chain(5, {}, 0);
    add_motion(batch, {KeyframeId(0), KeyframeId(2), step() * step(), information_of_step()});
    ASSERT_TRUE(window.optimize().outcome);
    ASSERT_TRUE(batch.optimize().outcome);
    EXPECT_EQ(window.marginalize().size(), 2u);
    ASSERT_TRUE(window.optimize().outcome);
    for (const int k : {2, 3})
      EXPECT_TRUE(
          relative_information(window, KeyframeId(k), KeyframeId(k + 1))
              .isApprox(relative_information(batch, KeyframeId(k), KeyframeId(k + 1)), 1e-6));
    EXPECT_LT(distance_m(window.pose(KeyframeId(2)).inverse() * window.pose(KeyframeId(4)),
                         step() * step()),
              1e-9);
  }
}

TEST(WindowMotion, OfFullRankMeasuresTheScale) {
  SlidingWindow window = chain(2, {}, 0);
  EXPECT_THROW(window.rescale(2), ArgumentError);
}

TEST(WindowMotion, ThatHoldsADirectionOnlyFollowsANewUnit) {
  // The way runs along z; how long it is, a distance says once the unit is known.
  Matrix6d across = Matrix6d::Zero();
  across(0, 0) = across(1, 1) = 1 / (0.01 * 0.01);
  SlidingWindow window({}, test::window_camera());
  window.add_keyframe(KeyframeId(0), SE3());
  window.add_keyframe(KeyframeId(1), SE3(SO3(), Eigen::Vector3d(0.2, 0, 1)));
  add_motion(window, {KeyframeId(0), KeyframeId(1), SE3(SO3(), Eigen::Vector3d(0, 0, 1)), across});
  window.rescale(3);
  EXPECT_LT((window.pose(KeyframeId(1)).translation() - Eigen::Vector3d(0.6, 0, 3)).norm(), 1e-12);
  const Matrix6d now = relative_information(window, KeyframeId(0), KeyframeId(1));
  EXPECT_NEAR(now(0, 0), 1 / (0.03 * 0.03), 1e-6 / (0.03 * 0.03)) << "in the new unit";
  EXPECT_LT(std::abs(now(2, 2)), 1e-6 * now(0, 0)) << "the length stays open";
}

TEST(WindowMotion, MustBeSoundAndBetweenTwoKeyframes) {
  SlidingWindow window = chain(2, {}, 0);
  EXPECT_THROW(add_motion(window, {KeyframeId(0), KeyframeId(0), step(), information_of_step()}),
               ArgumentError);
  EXPECT_THROW(add_motion(window, {KeyframeId(0), KeyframeId(5), step(), information_of_step()}),
               ArgumentError);
  EXPECT_THROW(add_motion(window, {KeyframeId(0), KeyframeId(1), step(), Matrix6d::Zero()}),
               ArgumentError);
  EXPECT_THROW(add_motion(window, {KeyframeId(0), KeyframeId(1), step(), -information_of_step()}),
               ArgumentError);
  Matrix6d skew = information_of_step();
  skew(0, 1) = 5;
  EXPECT_THROW(add_motion(window, {KeyframeId(0), KeyframeId(1), step(), skew}), ArgumentError);
}

}  // namespace window_motion_test
}  // namespace placegraph
