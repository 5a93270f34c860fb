#include <gtest/gtest.h>
#include <placegraph/frontend/markers/marker_pose.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/measurements/marker_layout.h>

#include "tests/support/scenes/marker_scene.h"
#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace marker_pose_test {

using namespace test;
using Code = Outcome::Code;
const Camera kCamera = MarkerScene::usual_camera();
constexpr double kSide_m = 0.2;

/// What an exact detector with deviation `sigma_px` would say; noise by `random` if given.
MarkerObservation observation_from(const SE3& T_cam_marker, double sigma_px,
                                   Random* random = nullptr) {
  MarkerObservation observation;
  PlacedMarker marker;
  marker.side_m = kSide_m;
  for (int k = 0; k < 4; ++k) {
    observation.corners_px[k] = *kCamera.project(T_cam_marker * marker.corners_marker()[k]);
    if (random)
      observation.corners_px[k] +=
          Eigen::Vector2d(random->normal(0, sigma_px), random->normal(0, sigma_px));
  }
  observation.covariance *= sigma_px * sigma_px;
  return observation;
}

TEST(MarkerPose, IsExactWithoutNoiseAndKeepsTheMirroredPose) {
  const SE3 truth = looking_at_origin(1.2, 0.6, 0.4, 0.2).inverse();
  const MarkerPoses found = estimate_marker_poses(observation_from(truth, 0.05), kSide_m, kCamera);
  ASSERT_TRUE(found.outcome) << found.outcome.reason;
  ASSERT_EQ(found.poses.size(), 2u);
  EXPECT_LT(distance_m(found.poses[0].T_cam_marker, truth), 1e-6);
  EXPECT_LT(angle_rad(found.poses[0].T_cam_marker, truth), 1e-6);
  EXPECT_NEAR(found.poses[0].rms_px, 0, 1e-4);
  // Mirrored about the line of sight: turned by twice the tilt, about.
  EXPECT_NEAR(angle_rad(found.poses[1].T_cam_marker, truth), 1.2, 0.15);
  EXPECT_GT(found.margin(), 100);
}

TEST(MarkerPose, CovarianceIsThatOfManyTrials) {
  Random random = seeded_random(5);
  const SE3 truth = looking_at_origin(0.8, 0.7, 0.4, 0.2).inverse();
  double sum = 0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto found =
        estimate_marker_poses(observation_from(truth, 0.1, &random), kSide_m, kCamera);
    ASSERT_TRUE(found.outcome);
    const Vector6d error = (found.poses[0].T_cam_marker.inverse() * truth).log();
    sum += error.dot(found.poses[0].covariance.ldlt().solve(error)) / 6;
  }
  // Deviation of a mean of 200 with variance 2/6 each: 0.04.
  EXPECT_NEAR(sum / kTrials, 1, 0.16);
}

TEST(MarkerPose, RefusesCornersThatAreNoFace) {
  MarkerObservation observation = observation_from(looking_at_origin(1, 0.3, 0, 0).inverse(), 0.1);
  MarkerObservation behind = observation;
  std::swap(behind.corners_px[1], behind.corners_px[3]);  // seen from its back
  EXPECT_EQ(estimate_marker_poses(behind, kSide_m, kCamera).outcome.code, Code::kDegenerate);
  MarkerObservation line = observation;
  for (int k = 0; k < 4; ++k) line.corners_px[k] = Eigen::Vector2d(100 + 10 * k, 100);
  EXPECT_EQ(estimate_marker_poses(line, kSide_m, kCamera).outcome.code, Code::kDegenerate);
  MarkerObservation unknown = observation;
  unknown.covariance.setZero();
  EXPECT_EQ(estimate_marker_poses(unknown, kSide_m, kCamera).outcome.code, Code::kDegenerate);
  EXPECT_THROW((void)estimate_marker_poses(observation, 0, kCamera), ArgumentError);
}

}  // namespace marker_pose_test
}  // namespace placegraph
