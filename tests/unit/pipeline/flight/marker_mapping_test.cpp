#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/flight/marker_mapping.h>

#include "tests/support/scenes/marker_scene.h"
#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace marker_mapping_test {

using namespace test;
using Code = Outcome::Code;
constexpr double kCorner_px = 0.1, kStep_m = 0.004, kStep_rad = 0.002;

/// Three markers on a floor with steps, a camera that goes past them, and noise on everything.
struct Walk {
  MarkerLayout layout;
  Camera camera = MarkerScene::usual_camera();
  std::vector<MarkerFrame> frames;
  std::vector<SE3> T_world_cam;

  explicit Walk(Random& random, int count = 30) {
    layout.markers = {{4, 0.2, SE3(SO3::exp({0, 0, 0.4}), {0, 0, 0})},
                      {7, 0.15, SE3(SO3::exp({0.2, 0, -1}), {0.6, 0.1, 0.1})},
                      {9, 0.2, SE3(SO3::exp({0, -0.1, 2}), {1.1, -0.1, 0.05})}};
    SE3 odometry = SE3(SO3::exp({0.3, 0.2, -0.1}), {5, 2, 1});  // some other world
    for (int i = 0; i < count; ++i) {
      const double along = 1.2 * i / count;
      SE3 T = looking_at_origin(1.3, 0.3, 0.5 + 0.05 * i, 0.2);
      T = SE3(T.rotation(), Eigen::Vector3d(T.translation() + Eigen::Vector3d(along, 0, 0)));
      MarkerFrame frame;
      Vector6d sigma, noise;
      sigma << Eigen::Vector3d::Constant(kStep_m), Eigen::Vector3d::Constant(kStep_rad);
      for (int k = 0; k < 6; ++k) noise[k] = random.normal(0, sigma[k]);
      if (i > 0) odometry = odometry * (T_world_cam.back().inverse() * T).plus(noise);
      frame.T_odom_cam = odometry;
      frame.step_covariance = sigma.cwiseAbs2().asDiagonal();
      for (const PlacedMarker& marker : layout.markers) observe(marker, T, random, frame);
      T_world_cam.push_back(T);
      frames.push_back(frame);
    }
  }
  void observe(const PlacedMarker& marker, const SE3& T, Random& random, MarkerFrame& frame) const {
    MarkerObservation observation;
    observation.id = marker.id;
    for (int k = 0; k < 4; ++k) {
      const auto px =
          camera.project(T.inverse() * marker.T_world_marker * marker.corners_marker()[k]);
      if (!px || !camera.contains(*px, 5)) return;
      observation.corners_px[k] =
          *px + Eigen::Vector2d(random.normal(0, kCorner_px), random.normal(0, kCorner_px));
    }
    observation.covariance *= kCorner_px * kCorner_px;
    frame.markers.push_back(observation);
  }
};

MarkerMapOptions exact_noise() {
  MarkerMapOptions options;
  options.extra_sigma_px = 0;  // the corners err as they say
  return options;
}

TEST(MarkerMap, FindsUnknownMarkersWithinTheirCovarianceFromAKnownOne) {
  Random random = seeded_random(1);
  double sum = 0;
  int count = 0;
  for (int trial = 0; trial < 5; ++trial) {
    const Walk walk(random);
    MarkerLayout known = walk.layout;
    known.markers.resize(1);
    const MarkerMap map =
        map_markers(walk.frames, known, {{7, 0.15}, {9, 0.2}}, walk.camera, exact_noise());
    ASSERT_TRUE(map.outcome) << map.outcome.reason;
    ASSERT_EQ(map.markers.size(), 3u);
    EXPECT_EQ(map.markers[0].covariance.norm(), 0);
    for (int i = 0; i < 3; ++i) {
      const SE3& truth = walk.layout.markers[i].T_world_marker;
      EXPECT_LT(distance_m(map.markers[i].marker.T_world_marker, truth), 0.02);
      if (i == 0) continue;
      const Vector6d error = (map.markers[i].marker.T_world_marker.inverse() * truth).log();
      sum += error.dot(map.markers[i].covariance.ldlt().solve(error)) / 6;
      ++count;
    }
  }
  // Ten values of mean 1 and variance 1/3: deviation of their mean 0.18.
  EXPECT_NEAR(sum / count, 1, 0.75);
}

TEST(MarkerMap, StandsInTheOdometrysWorldWhereNothingIsKnown) {
  Random random = seeded_random(2);
  const Walk walk(random);
  const MarkerMap map = map_markers(walk.frames, {}, {{4, 0.2}, {9, 0.2}}, walk.camera);
  ASSERT_TRUE(map.outcome) << map.outcome.reason;
  ASSERT_EQ(map.markers.size(), 2u);
  EXPECT_EQ(map.layout("apriltag_36h11").markers[1].id, 9);
  const SE3 between =
      map.markers[0].marker.T_world_marker.inverse() * map.markers[1].marker.T_world_marker;
  const SE3 truth =
      walk.layout.markers[0].T_world_marker.inverse() * walk.layout.markers[2].T_world_marker;
  EXPECT_LT(distance_m(between, truth), 0.03);
  EXPECT_LT(angle_rad(between, truth), 0.02);
}

/// Two frames show the known marker, two others the unknown one. The step between them is known to
/// 10 cm along each axis, the other steps to a millimetre and the poses of the markers to about a
/// centimetre, which is a hundredth in variance each.
TEST(MarkerMap, IsAsUncertainAsTheOdometryBetweenMarkersThatNoFrameShowsTogether) {
  Random random = seeded_random(4);
  const Walk walk(random);
  MarkerLayout known = walk.layout;
  known.markers.resize(1);
  std::vector<MarkerFrame> frames;
  for (const std::size_t i : {5, 6, 20, 21}) {
    MarkerFrame frame = walk.frames[i];
    std::erase_if(frame.markers, [&](const MarkerObservation& observation) {
      return observation.id != (i < 10 ? 4 : 9);
    });
    ASSERT_EQ(frame.markers.size(), 1u) << i;
    frame.T_odom_cam = walk.T_world_cam[i];
    const double sigma_m = i == 20 ? 0.1 : 1e-3;
    frame.step_covariance = 1e-6 * Matrix6d::Identity();
    frame.step_covariance.topLeftCorner<3, 3>() = sigma_m * sigma_m * Eigen::Matrix3d::Identity();
    frames.push_back(frame);
  }
  const MarkerMap map = map_markers(frames, known, {{9, 0.2}}, walk.camera);
  ASSERT_TRUE(map.outcome) << map.outcome.reason;
  ASSERT_EQ(map.markers.size(), 2u);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(map.markers[1].covariance(axis, axis), 0.01, 0.002) << axis;
}

TEST(MarkerMap, SaysWhereNothingWasSeenOftenEnough) {
  Random random = seeded_random(3);
  const Walk walk(random, 1);
  EXPECT_EQ(map_markers(walk.frames, {}, {{4, 0.2}}, walk.camera).outcome.code, Code::kTooFewData);
  EXPECT_EQ(map_markers({}, {}, {}, walk.camera).outcome.code, Code::kTooFewData);
  EXPECT_THROW((void)map_markers(walk.frames, {}, {{4, -0.2}}, walk.camera), ArgumentError);
}

}  // namespace marker_mapping_test
}  // namespace placegraph
