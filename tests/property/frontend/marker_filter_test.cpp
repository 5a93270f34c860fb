#include <gtest/gtest.h>
#include <placegraph/frontend/markers/marker_filter.h>
#include <placegraph/frontend/markers/marker_pose.h>
#include <placegraph/graph/core/angle.h>

#include <iostream>

#include "tests/support/scenes/marker_scene.h"
#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace marker_filter_test {

using namespace test;

/// Corners of a marker of 0.2 m with noise of this deviation, as a detector would tell them.
MarkerObservation observation_of(const PlacedMarker& placed, const SE3& T_world_cam,
                                 double sigma_px, Random& random) {
  const Camera camera = MarkerScene::usual_camera();
  MarkerObservation observation;
  observation.id = placed.id;
  for (int k = 0; k < 4; ++k)
    observation.corners_px[k] =
        *camera.project(T_world_cam.inverse() * placed.T_world_marker *
                        placed.corners_marker()[k]) +
        Eigen::Vector2d(random.normal(0, sigma_px), random.normal(0, sigma_px));
  observation.covariance *= sigma_px * sigma_px;
  return observation;
}

/// Over tilts from 0 to 75 degrees, ranges up to 5 m and noise up to a third of a pixel; corners
/// err as they say, so no allowance is made for more.
TEST(MarkerFilterProperty, ChoosesTheMirroredPoseInNoViewAndDecidesMostNearOnes) {
  Random random = seeded_random(21);
  MarkerLayout layout;
  layout.markers = {{3, 0.2, SE3()}};
  const Camera camera = MarkerScene::usual_camera();
  MarkerFilterOptions options;
  options.extra_sigma_px = 0;
  int wrong = 0, near = 0, near_decided = 0, decided = 0;
  double nees = 0;
  constexpr int kViews = 5000;
  for (int view = 0; view < kViews; ++view) {
    const double range = random.uniform(0.5, 5), sigma_px = random.uniform(0.02, 0.33);
    const SE3 truth = looking_at_origin(range, random.uniform(0, deg_to_rad(75)),
                                        random.uniform(0, 2 * std::numbers::pi),
                                        random.uniform(0, 2 * std::numbers::pi));
    MarkerView seen;
    seen.stamp_ns = 1;
    seen.markers = {observation_of(layout.markers[0], truth, sigma_px, random)};
    const MarkerPoseEstimate estimate = MarkerFilter(options, layout, camera, SE3()).observe(seen);
    near += range < 1.2 && sigma_px < 0.1;
    if (!estimate.outcome) continue;
    near_decided += range < 1.2 && sigma_px < 0.1;
    ++decided;
    const SE3& found = estimate.observation.T_world_body;
    const Vector6d error = (found.inverse() * truth).log();
    nees += error.dot(estimate.observation.covariance.ldlt().solve(error)) / 6;
    const MarkerPoses both =
        estimate_marker_poses(observation_of(layout.markers[0], truth, 1e-3, random), 0.2, camera);
    if (both.poses.size() < 2) continue;
    const SE3 rival = both.poses[1].T_cam_marker.inverse();
    // From right above both are one within the noise: an answer between them chooses neither.
    constexpr double kRefuted = 22.5;  // 99.9 % of chi^2 with six degrees of freedom
    const bool truth_refuted =
        error.dot(estimate.observation.covariance.ldlt().solve(error)) > kRefuted;
    wrong += truth_refuted && angle_rad(found, rival) < angle_rad(found, truth);
  }
  std::cout << "decided " << decided << " of " << kViews << ", near ones " << near_decided << " of "
            << near << "\n";
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(near_decided, 0.8 * near);
  EXPECT_GT(nees / decided, 0.5);
  EXPECT_LT(nees / decided, 2);
}

}  // namespace marker_filter_test
}  // namespace placegraph
