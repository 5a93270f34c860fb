#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>

#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace window_planes_test {

using test::angle_rad;
using test::distance_m;
using test::drive_window;
using test::make_window_world;
using test::WindowDrive;
using test::WindowWorld;
using test::WindowWorldOptions;

constexpr std::int64_t kPlane = WindowWorld::kFirstPlane;

WindowWorldOptions stereo_world() {
  WindowWorldOptions options;
  options.keyframes = 12;
  options.landmarks = 48;
  options.noise_px = options.sigma_px = 0.5;
  options.stereo = true;
  options.planes = 2;
  return options;
}

double angle_between(const Plane3& a, const Plane3& b) {
  return std::asin(std::min(1.0, a.normal().cross(b.normal()).norm()));
}

TEST(WindowPlanes, AreFoundWhereTheyWereMeasured) {
  Random random(41);
  WindowWorldOptions options = stereo_world();
  options.noise_px = 0;
  const WindowWorld world = make_window_world(options, random);
  const SlidingWindow window = drive_window(world, WindowDrive::exact(20), 5);
  for (std::size_t k = 0; k < 2; ++k) {
    const Plane3 plane = *window.plane(PlaneId(kPlane + static_cast<std::int64_t>(k)));
    EXPECT_LT(angle_between(plane, world.planes[k]), 1e-6);
    EXPECT_NEAR(std::abs(plane.distance()), std::abs(world.planes[k].distance()), 1e-5);
  }
  EXPECT_LT(distance_m(window.pose(KeyframeId(11)), world.T_map_cam[11]), 1e-5);
}

TEST(WindowPlanes, LeaveTheSamePosesInThePriorAsInTheBatch) {
  Random random(42);
  WindowWorldOptions options = stereo_world();
  options.views_per_landmark = 4;
  options.noise_px = 0.01;
  options.sigma_plane_rad = 3e-4;
  const WindowWorld world = make_window_world(options, random);
  const SlidingWindow window = drive_window(world, WindowDrive::exact(5), 6);
  const SlidingWindow batch = drive_window(world, WindowDrive::exact(100), 6);
  ASSERT_EQ(window.keyframes().size(), 5u);
  for (const KeyframeId id : window.keyframes()) {
    EXPECT_LT(distance_m(window.pose(id), batch.pose(id)), 1e-5);
    EXPECT_LT(angle_rad(window.pose(id), batch.pose(id)), 1e-6);
  }
  EXPECT_LT(window.plane(PlaneId(kPlane))->minus(*batch.plane(PlaneId(kPlane))).norm(), 1e-6);
  const Matrix6d a = relative_information(window, KeyframeId(7), KeyframeId(9)),
                 b = relative_information(batch, KeyframeId(7), KeyframeId(9));
  EXPECT_LT((a - b).norm(), 0.02 * b.norm());
  const Eigen::Matrix3d p = *plane_covariance(window, PlaneId(kPlane), KeyframeId(11)),
                        q = *plane_covariance(batch, PlaneId(kPlane), KeyframeId(11));
  EXPECT_LT((p - q).norm(), 0.05 * q.norm());
}

TEST(WindowPlanes, AreKnownFromAHeldKeyframeAsTheyWereMeasured) {
  SlidingWindow window({}, test::window_camera());
  const SE3 T_map_cam(SO3::exp({0.1, -0.2, 0.05}), Eigen::Vector3d(3, -1, 2));
  const Plane3 plane({0.2, 1, -0.1}, 4);
  const Plane3 plane_cam = transform_to(T_map_cam, plane);
  window.add_keyframe(KeyframeId(0), T_map_cam);
  window.add_plane(PlaneId(3), plane);
  EXPECT_FALSE(plane_covariance(window, PlaneId(3), KeyframeId(0)));
  const Eigen::Matrix3d information = plane_information(plane_cam, 0.01, 0.03);
  add_plane_observation(window, {KeyframeId(0), PlaneId(3), plane_cam, information});
  const Eigen::Matrix3d covariance = *plane_covariance(window, PlaneId(3), KeyframeId(0));
  EXPECT_LT((covariance * information - Eigen::Matrix3d::Identity()).norm(), 1e-9);
}

TEST(WindowPlanes, AreKnownFromAKeyframeWhicheverKeyframeIsHeld) {
  // From another keyframe, the covariance is that of the plane seen from there, plus the motion's.
  SlidingWindow window({}, test::window_camera());
  const SE3 T_map_first(SO3::exp({0.1, -0.2, 0.05}), Eigen::Vector3d(3, -1, 2));
  const SE3 T_first_second(SO3::exp({0.02, 0.3, 0}), Eigen::Vector3d(0.5, 0, 1));
  const Plane3 plane({0.2, 1, -0.1}, 4);
  const Plane3 plane_first = transform_to(T_map_first, plane);
  window.add_keyframe(KeyframeId(0), T_map_first);
  window.add_keyframe(KeyframeId(1), T_map_first * T_first_second);
  window.add_plane(PlaneId(3), plane);
  const Eigen::Matrix3d information = plane_information(plane_first, 0.01, 0.03);
  add_plane_observation(window, {KeyframeId(0), PlaneId(3), plane_first, information});
  const Matrix6d motion = Vector6d(1e4, 2e4, 3e4, 1e5, 2e5, 3e5).asDiagonal();
  add_motion(window, {KeyframeId(0), KeyframeId(1), T_first_second, motion});
  Eigen::Matrix<double, 3, 6> J_pose;
  Eigen::Matrix3d J_plane;
  transform_to(T_first_second, plane_first, &J_pose, &J_plane);
  const Eigen::Matrix3d expected = J_plane * information.inverse() * J_plane.transpose() +
                                   J_pose * motion.inverse() * J_pose.transpose();
  const Eigen::Matrix3d covariance = *plane_covariance(window, PlaneId(3), KeyframeId(1));
  EXPECT_LT((covariance - expected).norm(), 1e-6 * expected.norm());
  // And the first, held, knows it as it measured it.
  EXPECT_LT((*plane_covariance(window, PlaneId(3), KeyframeId(0)) * information -
             Eigen::Matrix3d::Identity())
                .norm(),
            1e-6);
}

TEST(WindowPlanes, LeaveWithTheLastKeyframeThatMeasuredThemUnlessTheyAreKept) {
  Random random(43);
  const WindowWorld world = make_window_world(stereo_world(), random);
  for (const bool kept : {false, true}) {
    WindowWorld short_range = world;
    std::erase_if(short_range.planes_seen,
                  [](const PlaneObservation& o) { return o.keyframe > KeyframeId(3); });
    Random disturbance(3);
    SlidingWindow window(WindowDrive::exact(5).options, world.camera);
    for (std::int64_t id = 0; id < 12; ++id) {
      window.add_keyframe(KeyframeId(id), world.T_map_cam[static_cast<std::size_t>(id)]);
      add_view(window, short_range, KeyframeId(id), 0.1, disturbance);
      if (id == 0) window.keep(plane_variable(PlaneId(kPlane)), kept);
      if (id > 0) {
        EXPECT_TRUE(window.optimize().outcome);
      }
      window.marginalize();
    }
    EXPECT_EQ(window.planes(), kept ? std::vector{PlaneId(kPlane)} : std::vector<PlaneId>());
    if (!kept) continue;
    // Unseen for a while it is known less well than a keyframe that measures it knows it.
    const SlidingWindow seen = drive_window(world, WindowDrive::exact(5), 3);
    EXPECT_GT(plane_covariance(window, PlaneId(kPlane), KeyframeId(11))->trace(),
              plane_covariance(seen, PlaneId(kPlane), KeyframeId(11))->trace());
  }
}

TEST(WindowPlanes, HoldTheWayBetterThanPointsAlone) {
  double with = 0, without = 0;
  for (std::uint64_t seed = 60; seed < 64; ++seed) {
    Random random(seed);
    WindowWorldOptions options = stereo_world();
    options.keyframes = 16;
    options.planes = 3;
    options.sigma_plane_rad = 5e-4;
    options.sigma_plane_m = 0.01;
    WindowWorld world = make_window_world(options, random);
    const auto error = [&] {
      const SlidingWindow window = drive_window(world, WindowDrive::exact(5), seed);
      return (window.pose(KeyframeId(15)).inverse() * world.T_map_cam[15]).log().squaredNorm();
    };
    with += error();
    world.planes_seen.clear();
    without += error();
  }
  EXPECT_LT(with, 0.2 * without);
}

TEST(WindowPlanes, AnOutlierIsSeenInItsResidualAndGoesAlone) {
  Random random(44);
  const WindowWorld world = make_window_world(stereo_world(), random);
  WindowDrive drive;
  drive.options.max_keyframes = 20;
  WindowWorld spoiled = world;
  PlaneObservation& wrong = spoiled.planes_seen[6];
  const KeyframeId keyframe = wrong.keyframe;
  wrong.plane_cam = wrong.plane_cam.plus({0.2, -0.1, 0.1});
  SlidingWindow window = drive_window(spoiled, drive, 7);
  EXPECT_GT(residual_sigmas(window, window_factor(wrong))->norm(), 10);
  const std::vector<WindowVariable> between{keyframe_variable(keyframe),
                                            plane_variable(PlaneId(kPlane))};
  for (const WindowFactor& seen : plane_observations(window)) {
    if (seen.variables != between) continue;
    window.remove(seen);
    EXPECT_THROW(window.remove(seen), ArgumentError);
  }
  EXPECT_TRUE(window.optimize().outcome);
  for (const WindowFactor& seen : plane_observations(window)) {
    EXPECT_NE(seen.variables, between);
    EXPECT_LT(residual_sigmas(window, seen)->norm(), 6);
  }
}

TEST(WindowPlanes, ForgottenOnesLeaveWhatElseIsKnown) {
  // Of a plane in the prior that nothing else ties to the keyframes, nothing is left but the rest.
  Random random(45);
  const WindowWorld world = make_window_world(stereo_world(), random);
  SlidingWindow window = drive_window(world, WindowDrive::exact(5), 8);
  const Matrix6d before = relative_information(window, KeyframeId(8), KeyframeId(11));
  const SE3 pose = window.pose(KeyframeId(11));
  window.remove_plane(PlaneId(kPlane));
  EXPECT_EQ(window.planes(), std::vector{PlaneId(kPlane + 1)});
  EXPECT_EQ(plane_observations(window).size(), 5u);
  const Matrix6d after = relative_information(window, KeyframeId(8), KeyframeId(11));
  EXPECT_GE(Eigen::SelfAdjointEigenSolver<Matrix6d>(before - after).eigenvalues()[0],
            -1e-6 * before.norm());
  EXPECT_TRUE(window.optimize().outcome);
  EXPECT_LT(distance_m(pose, window.pose(KeyframeId(11))), 0.1);
  window.marginalize();
  window.remove_plane(PlaneId(kPlane + 1));
  EXPECT_TRUE(window.optimize().outcome);
  EXPECT_TRUE(window.planes().empty());
}

TEST(WindowPlanes, MeasureTheUnitOfLength) {
  SlidingWindow window({}, test::window_camera());
  window.add_keyframe(KeyframeId(0), SE3());
  window.add_plane(PlaneId(1), Plane3(Eigen::Vector3d::UnitZ(), 3));
  window.rescale(2);
  EXPECT_NEAR(std::abs(window.plane(PlaneId(1))->distance()), 6, 1e-12);
  add_plane_observation(
      window, {KeyframeId(0), PlaneId(1), *window.plane(PlaneId(1)), Eigen::Matrix3d::Identity()});
  EXPECT_THROW(window.rescale(2), ArgumentError);
}

TEST(WindowPlanes, FaultyOnesAreRefused) {
  SlidingWindow window({}, test::window_camera());
  window.add_keyframe(KeyframeId(0), SE3());
  window.add_plane(PlaneId(1), Plane3());
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  EXPECT_THROW(add_plane_observation(window, {KeyframeId(5), PlaneId(1), Plane3(), I}),
               ArgumentError);
  EXPECT_THROW(add_plane_observation(window, {KeyframeId(0), PlaneId(2), Plane3(), I}),
               ArgumentError);
  EXPECT_THROW(add_plane_observation(window, {KeyframeId(0), PlaneId(1), Plane3(), -I}),
               ArgumentError);
  EXPECT_THROW(add_plane_observation(window, {KeyframeId(0), PlaneId(1), Plane3(), 0 * I}),
               ArgumentError);
  add_plane_observation(window, {KeyframeId(0), PlaneId(1), Plane3(), I});
  EXPECT_THROW(add_plane_observation(window, {KeyframeId(0), PlaneId(1), Plane3(), I}),
               ArgumentError);
  EXPECT_THROW(window.keep(plane_variable(PlaneId(2))), ArgumentError);
  EXPECT_THROW(window.remove_plane(PlaneId(2)), ArgumentError);
  EXPECT_FALSE(residual_sigmas(
      window, window_factor(PlaneObservation{KeyframeId(0), PlaneId(2), Plane3(), I})));
}

}  // namespace window_planes_test
}  // namespace placegraph
