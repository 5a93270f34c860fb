#include <numbers>

#include <gtest/gtest.h>
#include <placegraph/backend/inertial/error_state_filter.h>
#include <placegraph/frontend/markers/marker_filter.h>
#include <placegraph/frontend/markers/marker_pose.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/marker_scene.h"
#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace marker_filter_test {

using namespace test;
using Code = Outcome::Code;
const Camera kCamera = MarkerScene::usual_camera();
/// The camera looks down under the body's feet.
const SE3 kBodyCam(SO3::exp({std::numbers::pi, 0, 0}), Eigen::Vector3d(0.05, 0.02, -0.03));
constexpr double kSigma_px = 0.1;

MarkerLayout layout_of(int count) {
  MarkerLayout layout;
  for (int i = 0; i < count; ++i)
    layout.markers.push_back({i, 0.15, SE3(SO3::exp({0, 0, 0.3 * i}), {0.5 * i, 0.1 * i, 0})});
  return layout;
}

/// What a detector with noise says of the first `count` markers, the camera at `T_world_cam`.
MarkerView view_from(const MarkerLayout& layout, const SE3& T_world_cam, int count,
                     Random& random) {
  MarkerView view;
  view.stamp_ns = 1'000'000'000;
  for (int i = 0; i < count; ++i) {
    const PlacedMarker& placed = layout.markers[i];
    MarkerObservation observation;
    observation.id = placed.id;
    for (int k = 0; k < 4; ++k)
      observation.corners_px[k] =
          *kCamera.project(T_world_cam.inverse() * placed.T_world_marker *
                           placed.corners_marker()[k]) +
          Eigen::Vector2d(random.normal(0, kSigma_px), random.normal(0, kSigma_px));
    observation.covariance *= kSigma_px * kSigma_px;
    view.markers.push_back(observation);
  }
  return view;
}

MarkerFilter filter_for(const MarkerLayout& layout) {
  return MarkerFilter({}, layout, kCamera, kBodyCam);
}

TEST(MarkerFilter, KnowsThePoseWhereTheMarkerIsNear) {
  Random random = seeded_random(1);
  const MarkerLayout layout = layout_of(1);
  const SE3 T_world_cam = looking_at_origin(0.6, 0.5, 0.2, 0.4);
  const MarkerPoseEstimate estimate =
      filter_for(layout).observe(view_from(layout, T_world_cam, 1, random));
  ASSERT_TRUE(estimate.outcome) << estimate.outcome.reason;
  const SE3 truth = T_world_cam * kBodyCam.inverse();
  const Vector6d error = (estimate.observation.T_world_body.inverse() * truth).log();
  // 99.99 % of a chi-squared variable with six degrees of freedom.
  EXPECT_LT(error.dot(estimate.observation.covariance.ldlt().solve(error)), 27.9);
  EXPECT_EQ(estimate.markers, 1);
  EXPECT_EQ(estimate.hypotheses.size(), 1u);
}

/// Far away, a little tilted: two poses.
const SE3 kFar = looking_at_origin(4, 0.35, 0.2, 0.4);

TEST(MarkerFilter, SaysNothingWhileTwoPosesArePossible) {
  Random random = seeded_random(2);
  const MarkerLayout layout = layout_of(1);
  const MarkerPoseEstimate estimate =
      filter_for(layout).observe(view_from(layout, kFar, 1, random));
  EXPECT_EQ(estimate.outcome.code, Code::kInconsistent);
  EXPECT_EQ(estimate.hypotheses.size(), 2u);
}

TEST(MarkerFilter, DecidesByTheRotationBetweenViews) {
  Random random = seeded_random(3);
  const MarkerLayout layout = layout_of(1);
  MarkerFilter filter = filter_for(layout);
  SE3 before;
  MarkerPoseEstimate estimate;
  int views = 0;
  for (; views < 40 && !estimate.outcome; ++views) {
    const SE3 T_world_cam = looking_at_origin(4, 0.35 + 0.03 * views, 0.2, 0.4);
    MarkerView view = view_from(layout, T_world_cam, 1, random);
    view.stamp_ns += 50'000'000LL * views;
    const SE3 T_world_body = T_world_cam * kBodyCam.inverse();
    if (views > 0) view.rotation_body = before.rotation().inverse() * T_world_body.rotation();
    before = T_world_body;
    estimate = filter.observe(view);
  }
  ASSERT_TRUE(estimate.outcome) << estimate.outcome.reason;
  EXPECT_GT(views, 1);
  EXPECT_LT(angle_rad(estimate.observation.T_world_body, before), 0.2);
}

TEST(MarkerFilter, DecidesByAllMarkersInView) {
  Random random = seeded_random(4);
  const MarkerLayout layout = layout_of(3);
  const MarkerPoseEstimate estimate =
      filter_for(layout).observe(view_from(layout, kFar, 3, random));
  ASSERT_TRUE(estimate.outcome) << estimate.outcome.reason;
  EXPECT_EQ(estimate.markers, 3);
  EXPECT_LT(angle_rad(estimate.observation.T_world_body, kFar * kBodyCam.inverse()), 0.03);
}

TEST(MarkerFilter, LeavesOutAMarkerThatWasMoved) {
  Random random = seeded_random(5);
  const MarkerLayout layout = layout_of(3);
  MarkerLayout moved = layout;
  moved.markers[2].T_world_marker = moved.markers[2].T_world_marker * SE3(SO3(), {0.1, 0, 0});
  const SE3 T = looking_at_origin(2, 0.3, 0.2, 0.4);
  const MarkerPoseEstimate estimate = filter_for(layout).observe(view_from(moved, T, 3, random));
  ASSERT_TRUE(estimate.outcome) << estimate.outcome.reason;
  EXPECT_EQ(estimate.markers, 2);
  EXPECT_LT(distance_m(estimate.observation.T_world_body, T * kBodyCam.inverse()), 0.02);
}

TEST(MarkerFilter, DecidesByWhatTheStateFilterExpects) {
  Random random = seeded_random(6);
  const MarkerLayout layout = layout_of(1);
  ErrorStateFilter filter({}, kBodyCam);
  BodyState state;
  state.stamp_ns = 900'000'000;
  state.T_world_body = (kFar * kBodyCam.inverse()).plus(Vector6d::Constant(0.01));
  state.covariance.diagonal().setConstant(0.02 * 0.02);
  filter.start(state);
  const MarkerView view = view_from(layout, kFar, 1, random);
  const BodyExpectation expected = filter.expectation(view.stamp_ns);
  const MarkerPoseEstimate estimate = filter_for(layout).observe(view, &expected);
  ASSERT_TRUE(estimate.outcome) << estimate.outcome.reason;
  EXPECT_LT(angle_rad(estimate.observation.T_world_body, kFar * kBodyCam.inverse()), 0.1);
}

TEST(MarkerFilter, DecidesSoonerWhereUpIsKnown) {
  Random random = seeded_random(7);
  const MarkerLayout layout = layout_of(1);
  MarkerView view = view_from(layout, kFar, 1, random);
  MarkerFilter blind = filter_for(layout), upright = filter_for(layout);
  const MarkerPoseEstimate without = blind.observe(view);
  view.force_body = (kFar * kBodyCam.inverse()).rotation().inverse() * Eigen::Vector3d(0, 0, 9.8);
  const MarkerPoseEstimate with = upright.observe(view);
  ASSERT_EQ(without.hypotheses.size(), 2u);
  const SE3 truth = kFar * kBodyCam.inverse();
  EXPECT_LT(angle_rad(with.hypotheses[0].T_world_body, truth), 0.3);
  if (with.hypotheses.size() == 2) {
    EXPECT_LT(with.hypotheses[1].log_likelihood_sum, -5);
  }
}

TEST(MarkerFilter, BeginsByBeaconsWhereThereIsNoMarker) {
  Random random = seeded_random(8);
  MarkerScene scene;
  scene.camera = kCamera;
  scene.layout.beacons_world = {
      {-0.4, -0.3, 0}, {0.35, -0.25, 0.1}, {0.3, 0.4, 0}, {-0.2, 0.3, 0.2}, {0.05, -0.05, 0.05}};
  const SE3 T = looking_at_origin(1.8, 0.4, 0.3, 0.9);
  MarkerView view;
  view.stamp_ns = 1;
  view.beacons = detect_beacons(scene.render(T, random));
  MarkerFilter filter({}, scene.layout, kCamera, kBodyCam);
  const MarkerPoseEstimate estimate = filter.observe(view);
  ASSERT_TRUE(estimate.outcome) << estimate.outcome.reason;
  EXPECT_EQ(estimate.beacons, 5);
  EXPECT_LT(distance_m(estimate.observation.T_world_body, T * kBodyCam.inverse()), 0.01);
  // Three are enough where a filter expects the camera there.
  ErrorStateFilter other({}, kBodyCam);
  BodyState state;
  state.T_world_body = T * kBodyCam.inverse();
  state.covariance.diagonal().setConstant(0.01 * 0.01);
  other.start(state);
  view.beacons.resize(3);
  view.stamp_ns = 2;
  EXPECT_EQ(filter.observe(view).outcome.code, Code::kTooFewData);
  const BodyExpectation expected = other.expectation(view.stamp_ns);
  const MarkerPoseEstimate helped = filter.observe(view, &expected);
  ASSERT_TRUE(helped.outcome) << helped.outcome.reason;
  EXPECT_EQ(helped.beacons, 3);
}

TEST(MarkerFilter, SaysWhatItDoesNotKnow) {
  Random random = seeded_random(9);
  const MarkerLayout layout = layout_of(1);
  MarkerFilter filter = filter_for(layout);
  MarkerView view = view_from(layout, kFar, 1, random);
  view.markers[0].id = 99;
  EXPECT_EQ(filter.observe(view).outcome.code, Code::kTooFewData);
  view = view_from(layout, looking_at_origin(0.6, 0.5, 0, 0), 1, random);
  view.markers.push_back(view.markers[0]);  // twice the same number: which is it?
  EXPECT_EQ(filter.observe(view).outcome.code, Code::kTooFewData);
  EXPECT_THROW(filter_for(MarkerLayout()), ArgumentError);
  MarkerFilterOptions options;
  options.decided_log_ratio = 0;
  EXPECT_THROW(MarkerFilter(options, layout, kCamera, kBodyCam), ArgumentError);
}

TEST(MarkerFilter, ExpectsMarkersWhereTheyAreSeen) {
  Random random = seeded_random(10);
  const MarkerLayout layout = layout_of(3);
  const SE3 T = looking_at_origin(1, 0.1, 0, 0);
  const SE3 T_world_body = T * kBodyCam.inverse();
  constexpr double kSigma_m = 0.02, kSigma_rad = 0.01;
  Vector6d sigma;
  sigma << Eigen::Vector3d::Constant(kSigma_m), Eigen::Vector3d::Constant(kSigma_rad);
  const auto squares =
      filter_for(layout).expected_squares(T_world_body, sigma.cwiseAbs2().asDiagonal());
  ASSERT_GE(squares.size(), 1u);
  const MarkerView view = view_from(layout, T, 1, random);
  const auto apart = [&](const ExpectedSquare& square, int corner) {
    return (square.corners_px[corner] - view.markers[0].corners_px[corner]).norm();
  };
  for (int k = 0; k < 4; ++k) EXPECT_LT(apart(squares[0], k), 1);
  // Poses as far off as they are said to be expect it no farther off than they say.
  for (int trial = 0; trial < 50; ++trial) {
    Vector6d error;
    for (int i = 0; i < 6; ++i) error[i] = sigma[i] * random.normal();
    const auto off = filter_for(layout).expected_squares(T_world_body.plus(error),
                                                         sigma.cwiseAbs2().asDiagonal());
    ASSERT_GE(off.size(), 1u);
    for (int k = 0; k < 4; ++k) EXPECT_LT(apart(off[0], k), *off[0].within_px);
  }
  EXPECT_LT(*squares[0].within_px, 0.15 * kCamera.fx);  // at 1 m: four times 0.02 m and 0.01 rad
}

}  // namespace marker_filter_test
}  // namespace placegraph
