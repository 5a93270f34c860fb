#include <gtest/gtest.h>
#include <placegraph/frontend/markers/beacon_pose.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/marker_scene.h"
#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace beacon_test {

using namespace test;
using Code = Outcome::Code;

MarkerScene lamps() {
  MarkerScene scene;
  scene.camera = MarkerScene::usual_camera();
  scene.layout.beacons_world = {
      {-0.4, -0.3, 0}, {0.35, -0.25, 0.1}, {0.3, 0.4, 0}, {-0.2, 0.3, 0.2}, {0.05, -0.05, 0.05}};
  return scene;
}
const SE3 kPose = looking_at_origin(1.8, 0.4, 0.3, 0.9);

std::vector<BeaconObservation> exact_spots(const MarkerScene& scene, const SE3& T_world_cam) {
  std::vector<BeaconObservation> spots;
  for (const Eigen::Vector3d& beacon : scene.layout.beacons_world) {
    BeaconObservation spot;
    spot.px = *scene.camera.project(T_world_cam.inverse() * beacon);
    spot.covariance *= 0.1 * 0.1;
    spots.push_back(spot);
  }
  return spots;
}

TEST(BeaconDetector, FindsSpotsThatBloomBelowATenthOfAPixel) {
  Random random = seeded_random(1);
  const MarkerScene scene = lamps();
  const auto spots = detect_beacons(scene.render(kPose, random));
  ASSERT_EQ(spots.size(), 5u);
  double squared = 0;
  for (const BeaconObservation& spot : spots) {
    double nearest = 1e9;
    for (const BeaconObservation& exact : exact_spots(scene, kPose))
      nearest = std::min(nearest, (exact.px - spot.px).norm());
    EXPECT_LT(nearest, 0.15);
    EXPECT_LT(nearest * nearest, 16 * spot.covariance.trace());
    squared += nearest * nearest;
  }
  EXPECT_LT(std::sqrt(squared / 5), 0.1);
}

TEST(BeaconDetector, LeavesOutWhatIsNoSpot) {
  Image image(100, 100, CV_8UC1, cv::Scalar(60));
  image(cv::Rect(10, 10, 40, 2)) = 255;   // a line
  image(cv::Rect(60, 60, 35, 35)) = 255;  // a sheet
  image.at<std::uint8_t>(30, 80) = 150;   // dim
  EXPECT_TRUE(detect_beacons(image).empty());
  image(cv::Rect(0, 70, 3, 3)) = 255;  // cut by the image's border
  EXPECT_TRUE(detect_beacons(image).empty());
  image(cv::Rect(30, 70, 3, 3)) = 255;
  ASSERT_EQ(detect_beacons(image).size(), 1u);
  EXPECT_LT((detect_beacons(image)[0].px - Eigen::Vector2d(31, 71)).norm(), 1e-9);
  EXPECT_THROW((void)detect_beacons(Image()), ArgumentError);
}

TEST(BeaconPose, FindsThePoseFromSpotsThatAllLookTheSame) {
  Random random = seeded_random(2);
  const MarkerScene scene = lamps();
  auto spots = detect_beacons(scene.render(kPose, random));
  BeaconObservation other;  // something else that shines
  other.px = {50, 60};
  other.covariance *= 0.01;
  spots.push_back(other);
  const BeaconPose found = find_beacon_pose(spots, scene.layout.beacons_world, scene.camera);
  ASSERT_TRUE(found.outcome) << found.outcome.reason;
  EXPECT_EQ(found.pairs.size(), 5u);
  EXPECT_LT(distance_m(found.T_world_cam, kPose), 0.01);
  EXPECT_LT(angle_rad(found.T_world_cam, kPose), 0.01);
}

TEST(BeaconPose, SaysSoWhereTheLayoutCannotTell) {
  MarkerScene scene = lamps();
  const auto& beacons = scene.layout.beacons_world = {
      {-0.3, -0.3, 0}, {0.3, -0.3, 0}, {0.3, 0.3, 0}, {-0.3, 0.3, 0}};  // a square
  const auto spots = exact_spots(scene, kPose);
  EXPECT_EQ(find_beacon_pose(spots, beacons, scene.camera).outcome.code, Code::kInconsistent);
  EXPECT_EQ(find_beacon_pose({spots[0], spots[1], spots[2]}, beacons, scene.camera).outcome.code,
            Code::kTooFewData);
  auto moved = spots;
  moved[2].px += Eigen::Vector2d(60, 35);
  EXPECT_EQ(find_beacon_pose(moved, beacons, scene.camera).outcome.code, Code::kNoConsensus);
}

TEST(BeaconPose, GivesSpotsToTheBeaconsExpectedThere) {
  const MarkerScene scene = lamps();
  auto spots = exact_spots(scene, kPose);
  std::swap(spots[0], spots[3]);
  spots.pop_back();
  const Matrix6d covariance = 1e-6 * Matrix6d::Identity();
  const BeaconPairs expected = {{3, 0}, {1, 1}, {2, 2}, {0, 3}};
  EXPECT_EQ(assign_beacons(spots, scene.layout.beacons_world, scene.camera, kPose, covariance),
            expected);
  // A second spot beside one: neither is believed.
  spots.push_back(spots[0]);
  EXPECT_EQ(
      assign_beacons(spots, scene.layout.beacons_world, scene.camera, kPose, covariance).size(),
      3u);
}

}  // namespace beacon_test
}  // namespace placegraph
