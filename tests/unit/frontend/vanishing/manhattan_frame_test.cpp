#include <gtest/gtest.h>
#include <placegraph/frontend/vanishing/manhattan_frame.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/manhattan_scene.h"

namespace placegraph {
namespace manhattan_frame_test {

using Code = Outcome::Code;

TEST(ManhattanFrame, NearestOfTheTwentyFourFrames) {
  const SO3 like = SO3::exp({0.1, -0.2, 0.3});
  Eigen::Matrix3d P;  // x -> y, y -> -x
  P << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const SO3 rotated = like * SO3::from_matrix(P);
  EXPECT_LT((nearest_axes(rotated, like).inverse() * like).log().norm(), 1e-9);
  P << 0, 0, 1, 0, -1, 0, 1, 0, 0;
  EXPECT_LT((nearest_axes(like * SO3::from_matrix(P), like).inverse() * like).log().norm(), 1e-9);
}

TEST(ManhattanFrame, IsFoundNearestToTheCamerasAxes) {
  const Camera camera = test::vanishing_camera();
  const SO3 R = SO3::exp({0.05, 0.3, -0.02});
  Random random(1);
  const auto segments = test::manhattan_segments(camera, R, 30, 20, 0.2, random);
  const auto frame = estimate_manhattan_frame(segments, camera, {}, {}, random);
  ASSERT_TRUE(frame.outcome) << frame.outcome.reason;
  EXPECT_EQ(frame.rank, 3);
  EXPECT_LT((frame.R_cam_manhattan.inverse() * R).log().norm(), 0.004);
  EXPECT_LT((frame.covariance * frame.information - Eigen::Matrix3d::Identity()).norm(), 1e-6);
  int right = 0;
  for (std::size_t i = 0; i < 90; ++i) right += frame.axis[i] == static_cast<int>(i / 30);
  EXPECT_GE(right, 80);
}

TEST(ManhattanFrame, DirectionsFarFromRightAnglesMakeNone) {
  const Camera camera = test::vanishing_camera();
  Random random(2);
  std::vector<LineSegment> segments;
  test::add_edges(camera, {1, 0, 0.1}, 40, 0.3, random, segments);
  test::add_edges(camera, Eigen::Vector3d(0.6, 0, 0.8), 40, 0.3, random, segments);
  const auto frame = estimate_manhattan_frame(segments, camera, {}, {}, random);
  EXPECT_EQ(frame.outcome.code, Code::kNoConsensus);
  EXPECT_EQ(frame.rank, 0);
  EXPECT_EQ(frame.information, Eigen::Matrix3d::Zero());
}

TEST(ManhattanFrame, FewSegmentsAreTooFew) {
  const Camera camera = test::vanishing_camera();
  Random random(2);
  const std::vector<LineSegment> one = {{{10, 10}, {60, 12}}};
  EXPECT_EQ(estimate_manhattan_frame({}, camera, {}, {}, random).outcome.code, Code::kTooFewData);
  EXPECT_EQ(estimate_manhattan_frame(one, camera, {}, {}, random).outcome.code, Code::kTooFewData);
  EXPECT_EQ(track_manhattan_frame(one, camera, SO3(), 0.02, {}, {}).outcome.code,
            Code::kTooFewData);
}

TEST(ManhattanFrame, IsTrackedFromAPrediction) {
  const Camera camera = test::vanishing_camera();
  const SO3 R = SO3::exp({0.1, 2.3, -0.2});  // far from the camera's axes: continuity decides
  Random random(3);
  const auto segments = test::manhattan_segments(camera, R, 30, 40, 0.3, random);
  const auto frame =
      track_manhattan_frame(segments, camera, R.plus({0.02, -0.03, 0.02}), 0.04, {}, {});
  ASSERT_TRUE(frame.outcome) << frame.outcome.reason;
  EXPECT_EQ(frame.rank, 3);
  EXPECT_LT((frame.R_cam_manhattan.inverse() * R).log().norm(), 0.005);
}

TEST(ManhattanFrame, OneAxisLeavesTheRotationAboutItOpen) {
  const Camera camera = test::vanishing_camera();
  const SO3 R = SO3::exp({0.1, 0.2, -0.1});
  Random random(4);
  std::vector<LineSegment> segments;
  test::add_edges(camera, R.matrix().col(1), 40, 0.3, random, segments);
  const SO3 predicted = R.plus({0, 0.03, 0});  // about the axis seen
  const auto frame = track_manhattan_frame(segments, camera, predicted, 0.04, {}, {});
  ASSERT_TRUE(frame.outcome) << frame.outcome.reason;
  EXPECT_EQ(frame.rank, 2);
  EXPECT_EQ(frame.covariance, Eigen::Matrix3d::Zero());
  const Eigen::Vector3d own = Eigen::Vector3d::UnitY();
  EXPECT_LT(own.dot(frame.information * own), 1e-6 * frame.information.trace());
  EXPECT_LT((frame.R_cam_manhattan.inverse() * predicted).log().norm(), 0.01);
}

TEST(ManhattanFrame, ClutterShowsNoAxisToTrack) {
  const Camera camera = test::vanishing_camera();
  Random random(5);
  std::vector<LineSegment> segments;
  test::add_clutter(camera, 60, random, segments);
  EXPECT_EQ(track_manhattan_frame(segments, camera, SO3(), 0.02, {}, {}).outcome.code,
            Code::kDegenerate);
  EXPECT_THROW(
      { [[maybe_unused]] auto f = track_manhattan_frame(segments, camera, SO3(), 0, {}, {}); },
      ArgumentError);
}

}  // namespace manhattan_frame_test
}  // namespace placegraph
