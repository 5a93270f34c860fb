#include <gtest/gtest.h>
#include <placegraph/pipeline/scale/floor_line_scale.h>
#include <placegraph/pipeline/scale/ground_plane_scale.h>

#include "tests/support/scenes/room_lines.h"
#include "tests/support/scenes/texture.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace scale_test {

using namespace test;

// GroundPlaneScale
// -------------------------------------------------------------------------------------

/// Two pictures of a road from 1.2 to 2 m above it, a step of random length apart.
struct Road {
  Camera camera = pinhole(360, 190, 400);
  double height_m, step_m;
  Image old_view, new_view;
  SE3 T_old_new;

  explicit Road(Random& random)
      : height_m(random.uniform(1.2, 2)), step_m(height_m * random.uniform(0.4, 0.6)) {
    camera.cy = 40;  // it looks at the road only
    const double pitch = random.uniform(0, 0.04), yaw = random.uniform(-0.01, 0.01);
    const SE3 T_world_old = pose({-pitch, 0, 0}, {0, -height_m, 0}),
              T_world_new = pose({-pitch, yaw, 0}, {0.1 * step_m, -height_m, step_m});
    Eigen::Matrix3d R_world_ground;
    R_world_ground << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    const TexturedPlane ground{SE3(R_world_ground, Eigen::Vector3d::Zero()),
                               1e3,
                               1e3,
                               {static_cast<std::uint64_t>(random.index(1000)), 1.2, 2, 60}};
    old_view = render(camera, T_world_old, {ground}, 2).grey;
    new_view = render(camera, T_world_new, {ground}, 2).grey;
    T_old_new = T_world_old.inverse() * T_world_new;
  }
  /// Where lengths are measured in units of `unit` metres, and the camera is thought to stand
  /// `height` above the road.
  double factor(double unit, double height, bool backwards = false) const {
    GroundPlaneScale scale({}, camera, height);
    const SE3 T = T_old_new.scaled(1 / unit);
    const auto length =
        backwards ? scale.find(old_view, new_view, T.inverse()) : scale.find(new_view, old_view, T);
    EXPECT_TRUE(length);
    return length ? length->factor : 0;
  }
};
/// Of a single scale: three of the deviations that the estimator claims at least, 2 % each.
constexpr double kShare = 0.06;

TEST(GroundScaleLaws, TheFactorIsTheUnit) {
  Random random = seeded_random(1);
  for (int trial = 0; trial < 4; ++trial) {
    const Road road(random);
    const double metric = road.factor(1, road.height_m);
    EXPECT_NEAR(metric, 1, kShare);
    const double unit = random.uniform(0.05, 20);
    EXPECT_NEAR(road.factor(unit, road.height_m) / unit, metric, 1e-6);
  }
}

TEST(GroundScaleLaws, AHigherCameraMakesLongerSteps) {
  Random random = seeded_random(2);
  for (int trial = 0; trial < 3; ++trial) {
    const Road road(random);
    const double s = random.uniform(0.2, 5);
    // The same pictures in a world s times larger: the search is in heights of the camera.
    EXPECT_NEAR(road.factor(1, s * road.height_m) / road.factor(1, road.height_m), s, 1e-6 * s);
  }
}

TEST(GroundScaleLaws, ExchangedViewsTellTheSameLength) {
  Random random = seeded_random(3);
  for (int trial = 0; trial < 4; ++trial) {
    const Road road(random);
    EXPECT_NEAR(road.factor(1, road.height_m, true) / road.factor(1, road.height_m), 1, kShare);
  }
}

// FloorLineScale
// --------------------------------------------------------------------------------------

/// Lines of a corridor in units of `unit` metres, as a camera at `T_odom_cam` sees them that stands
/// at `T_corridor_cam` [m], placed with an error of their tangents.
std::vector<PlacedLine> placed(const SE3& T_corridor_cam, const SE3& T_odom_cam, double unit,
                               double sigma, Random random) {
  const LineScene scene = corridor_lines();
  const SE3 T_cam_corridor = T_corridor_cam.inverse();
  std::vector<PlacedLine> lines;
  for (std::size_t i = 0; i < scene.from.size(); ++i) {
    const Eigen::Vector3d a = T_cam_corridor * scene.from[i], b = T_cam_corridor * scene.to[i];
    const auto start = scene.camera.project(a), end = scene.camera.project(b);
    if (!start || !end) continue;
    const Eigen::Vector3d from = T_odom_cam * (a / unit), to = T_odom_cam * (b / unit);
    Eigen::Vector4d error;
    for (int k = 0; k < 4; ++k) error[k] = sigma * random.normal();
    Eigen::Matrix4d covariance = sigma * sigma * Eigen::Matrix4d::Identity();
    lines.push_back({LineId(i),
                     Line3::from_direction(from, to - from).plus(error),
                     covariance,
                     {*start, *end}});
  }
  return lines;
}

/// The factor after three views that agree on it.
double floor_factor(double height_m, double unit, const SE3& T_odom_corridor,
                    const Random& random) {
  FloorLineScale scale({}, LineScene().camera, height_m);
  std::optional<GroundPlaneScale::ScaleMeasurement> length;
  for (int view = 0; view < 3; ++view) {
    const SE3 T_corridor_cam = pose({0.02, 0.05, 0}, {0.1, 0, 0.2 * view});
    const SE3 T_odom_cam = T_odom_corridor * T_corridor_cam.scaled(1 / unit);
    length = scale.measure(
        T_odom_cam, placed(T_corridor_cam, T_odom_cam, unit, 2e-4 / unit, random), {}, false);
    EXPECT_EQ(length.has_value(), view == 2) << view;
  }
  return length ? length->factor : 0;
}

TEST(FloorScaleLaws, TheFactorIsTheUnitWhateverTheFrame) {
  Random random = seeded_random(4);
  for (int trial = 0; trial < 10; ++trial) {
    const double unit = random.uniform(0.3, 3);
    const SE3 T_odom_corridor = pose({random.normal(), random.normal(), random.normal()},
                                     {random.normal(), random.normal(), random.normal()});
    EXPECT_NEAR(floor_factor(1.4, unit, T_odom_corridor, random) / unit, 1, 0.02);
  }
}

TEST(FloorScaleLaws, AHigherCameraMakesALargerScene) {
  Random random = seeded_random(5);
  for (int trial = 0; trial < 10; ++trial) {
    const double s = random.uniform(0.2, 5);
    EXPECT_NEAR(floor_factor(1.4 * s, 1, SE3(), random) / floor_factor(1.4, 1, SE3(), random), s,
                1e-9 * s);
  }
}

}  // namespace scale_test
}  // namespace placegraph
