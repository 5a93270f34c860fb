#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>

#include "tests/support/ids.h"
#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace window_landmarks_test {

using test::distance_m;
using test::drive_window;
using test::make_window_world;
using test::WindowDrive;
using test::WindowWorld;
using test::WindowWorldOptions;

void expect_on_path(const SlidingWindow& window, const WindowWorld& world, double tolerance_m) {
  for (const KeyframeId id : window.keyframes())
    EXPECT_LT(distance_m(window.pose(id), world.T_map_cam[static_cast<std::size_t>(id.value())]),
              tolerance_m)
        << "keyframe " << id;
}

WindowWorldOptions line_world() {
  WindowWorldOptions options;
  options.keyframes = 10;
  options.landmarks = 6;  // too few points by themselves
  options.lines = 50;
  options.stereo = true;
  return options;
}

TEST(WindowLines, CarryAWindowThatSeesHardlyAPoint) {
  Random random(21);
  const WindowWorld world = make_window_world(line_world(), random);
  SlidingWindow window(WindowDrive::exact(20).options, world.camera);
  for (std::size_t k = 0; k < world.T_map_cam.size(); ++k) {
    const SE3 step = k == 0 ? SE3() : test::random_motion(random, 0.01, 0.001);
    window.add_keyframe(KeyframeId(k), world.T_map_cam[k] * step);
    add_view(window, world, KeyframeId(k), 0.3, random);
  }
  const WindowSummary summary = window.optimize();
  ASSERT_TRUE(summary.outcome) << summary.outcome.reason;
  expect_on_path(window, world, 1e-6);
  for (const LineId id : window.lines()) {
    const Line3 truth = world.lines[static_cast<std::size_t>(id.value())], line = *window.line(id);
    EXPECT_LT(line.direction().cross(truth.direction()).norm(), 1e-5) << "line " << id;
    EXPECT_LT(truth.distance_to(line.nearest_point()), 1e-4) << "line " << id;
  }
}

TEST(WindowLines, LeaveTheSamePosesInThePriorAsInTheBatch) {
  Random random(23);
  WindowWorldOptions options = line_world();
  options.landmarks = 60;
  options.views_per_landmark = 4;
  options.noise_px = 0.01;
  options.sigma_px = 0.5;
  const WindowWorld world = make_window_world(options, random);
  const SlidingWindow window = drive_window(world, WindowDrive::exact(5), 24);
  const SlidingWindow batch = drive_window(world, WindowDrive::exact(100), 24);
  ASSERT_EQ(window.keyframes().size(), 5u);
  EXPECT_LT(window.lines().size(), batch.lines().size());
  for (const KeyframeId id : window.keyframes())
    EXPECT_LT(distance_m(window.pose(id), batch.pose(id)), 5e-6);
  const Matrix6d a = relative_information(window, KeyframeId(7), KeyframeId(9)),
                 b = relative_information(batch, KeyframeId(7), KeyframeId(9));
  EXPECT_LT((a - b).norm(), 0.02 * b.norm());
}

TEST(WindowLines, SeenTwiceSayNothingOfThePoses) {
  Random random(25);
  WindowWorldOptions options = line_world();
  options.lines = 0;
  options.landmarks = 60;
  const WindowWorld world = make_window_world(options, random);
  SlidingWindow window = drive_window(world, WindowDrive::exact(20), 26);
  const Matrix6d before = relative_information(window, KeyframeId(2), KeyframeId(5));
  window.add_line(LineId(0), Line3::from_direction({0, 0, 12}, {1, 2, 0}));
  window.add_line_observation({KeyframeId(4), LineId(0), {600, 100}, {700, 300}, 1});
  window.add_line_observation({KeyframeId(5), LineId(0), {100, 100}, {900, 120}, 1});
  const SE3 pose = window.pose(KeyframeId(5));
  ASSERT_TRUE(window.optimize().outcome);
  EXPECT_LT(distance_m(window.pose(KeyframeId(5)), pose), 1e-9);
  EXPECT_LT((relative_information(window, KeyframeId(2), KeyframeId(5)) - before).norm(),
            1e-9 * before.norm());
}

WindowWorldOptions ground_world() {
  WindowWorldOptions options;
  options.keyframes = 10;
  options.landmarks = 80;
  options.ground_points = 30;
  options.sigma_height_m = 0.02;
  return options;
}

TEST(WindowGround, GivesAMonoDriveItsScale) {
  Random random(27);
  const WindowWorld world = make_window_world(ground_world(), random);
  for (const int max_keyframes : {20, 5}) {
    WindowDrive drive = WindowDrive::exact(max_keyframes);
    drive.disturbance = 0.3;
    const SlidingWindow window = drive_window(world, drive, 28);
    expect_on_path(window, world, max_keyframes == 20 ? 1e-5 : 1e-3);
    EXPECT_NEAR(std::abs(window.plane(PlaneId(0))->distance()), 1.65, 1e-3);
    EXPECT_TRUE(relative_covariance(window, KeyframeId(7), KeyframeId(9)));
  }
}

TEST(WindowGround, LeavesTheSamePosesInThePriorAsInTheBatch) {
  Random random(29);
  WindowWorldOptions options = ground_world();
  options.views_per_landmark = 4;
  options.noise_px = 0.01;
  options.sigma_px = 0.5;
  options.sigma_ground_m = 0.002;
  options.sigma_height_m = 0.002;
  const WindowWorld world = make_window_world(options, random);
  const SlidingWindow window = drive_window(world, WindowDrive::exact(5), 30);
  const SlidingWindow batch = drive_window(world, WindowDrive::exact(100), 30);
  for (const KeyframeId id : window.keyframes())
    EXPECT_LT(distance_m(window.pose(id), batch.pose(id)), 1e-3);
  const Matrix6d a = relative_information(window, KeyframeId(7), KeyframeId(9)),
                 b = relative_information(batch, KeyframeId(7), KeyframeId(9));
  EXPECT_LT((a - b).norm(), 0.05 * b.norm());
}

TEST(WindowGround, LeavesWithTheLastKeyframeAndPointThatSpeakOfIt) {
  Random random(31);
  WindowWorldOptions options = ground_world();
  options.stereo = true;
  const WindowWorld world = make_window_world(options, random);
  SlidingWindow window = drive_window(world, WindowDrive::exact(8), 32);
  EXPECT_EQ(window.planes(), std::vector{PlaneId(0)});
  // Further keyframes see other points only.
  for (std::int64_t id = 10; id < 19; ++id) {
    window.add_keyframe(KeyframeId(id),
                        window.pose(KeyframeId(id - 1)) * SE3(SO3(), Eigen::Vector3d(0, 0, 0.5)));
    for (int i = 0; i < 12; ++i) {
      const std::int64_t landmark = 1000 + i;
      const Eigen::Vector3d p_map =
          world.T_map_cam.back() * Eigen::Vector3d(i % 4 - 1.5, i % 3 - 1, 14 + i);
      if (id == 10) window.add_landmark(LandmarkId(landmark), p_map);
      const Eigen::Vector3d p_cam = window.pose(KeyframeId(id)).inverse() * p_map;
      window.add_observation({KeyframeId(id), LandmarkId(landmark), *world.camera.project(p_cam), 1,
                              1 / p_cam.z(), 1e-3});
    }
    window.marginalize();
  }
  EXPECT_TRUE(window.planes().empty());
  EXPECT_TRUE(window.optimize().outcome);
  EXPECT_TRUE(relative_covariance(window, KeyframeId(17), KeyframeId(18)));
}

TEST(WindowPosePrior, HoldsTheWindowWhereItSays) {
  Random random(33);
  WindowWorldOptions options;
  options.stereo = true;
  const WindowWorld world = make_window_world(options, random);
  SlidingWindow window(WindowDrive::exact(20).options, world.camera);
  fill_window(window, world, random, 0.02, 0.002, 0.1);
  const SE3 moved(SO3::exp({0.01, 0.05, 0.02}), Eigen::Vector3d(0.5, -0.3, 0.2));
  add_pose_prior(window, {KeyframeId(0), moved * world.T_map_cam[0], 1e4 * Matrix6d::Identity()});
  ASSERT_TRUE(window.optimize().outcome);
  for (const KeyframeId id : window.keyframes())
    EXPECT_LT(
        distance_m(window.pose(id), moved * world.T_map_cam[static_cast<std::size_t>(id.value())]),
        1e-5);
  // Nothing else speaks of keyframe 0 in the map.
  const Matrix6d covariance = *keyframe_covariance(window, KeyframeId(0));
  EXPECT_LT((covariance - 1e-4 * Matrix6d::Identity()).norm(), 1e-8);
}

TEST(WindowPosePrior, CountsAsOneMoreMeasurement) {
  Random random(35);
  WindowWorldOptions options;
  options.stereo = true;
  options.noise_px = options.sigma_px = 0.5;
  const WindowWorld world = make_window_world(options, random);
  SlidingWindow window(WindowDrive::exact(20).options, world.camera);
  fill_window(window, world, random, 0.02, 0.002, 0.1);
  ASSERT_TRUE(window.optimize().outcome);
  const Matrix6d before = keyframe_covariance(window, KeyframeId(7))->inverse();
  Matrix6d information = Matrix6d::Zero();
  information(2, 2) = 1e6;  // the position ahead only
  add_pose_prior(window, {KeyframeId(7), world.T_map_cam[7], information});
  ASSERT_TRUE(window.optimize().outcome);
  const Matrix6d after = keyframe_covariance(window, KeyframeId(7))->inverse();
  EXPECT_NEAR(after(2, 2) - before(2, 2), 1e6, 0.02 * before(2, 2));
  EXPECT_NEAR(after(0, 0), before(0, 0), 0.02 * before(0, 0));
}

TEST(WindowCovariance, IsTheInverseOfTheInformationAndNothingWhereThatIsSingular) {
  Random random(37);
  WindowWorldOptions options;
  const WindowWorld mono = make_window_world(options, random);
  SlidingWindow without_scale(WindowDrive::exact(20).options, mono.camera);
  fill_window(without_scale, mono, random, 0, 0, 0);
  EXPECT_FALSE(relative_covariance(without_scale, KeyframeId(2), KeyframeId(6)));
  options.stereo = true;
  const WindowWorld world = make_window_world(options, random);
  SlidingWindow window(WindowDrive::exact(20).options, world.camera);
  fill_window(window, world, random, 0, 0, 0);
  const Matrix6d covariance = *relative_covariance(window, KeyframeId(2), KeyframeId(6));
  EXPECT_LT((covariance * relative_information(window, KeyframeId(2), KeyframeId(6)) -
             Matrix6d::Identity())
                .norm(),
            1e-8);
  // The first keyframe is held: in the map and relative to it is the same.
  EXPECT_TRUE(keyframe_covariance(window, KeyframeId(0))->isZero(0));
  const Matrix6d in_map = *keyframe_covariance(window, KeyframeId(6)),
                 relative = *relative_covariance(window, KeyframeId(0), KeyframeId(6));
  EXPECT_LT((in_map - relative).norm(), 1e-6 * in_map.norm());
}

TEST(WindowKeep, LeavesAnAnchorInTheWindowUntilItIsReleased) {
  Random random(39);
  WindowWorldOptions options;
  options.keyframes = 14;
  options.landmarks = 150;
  options.views_per_landmark = 4;
  options.stereo = true;
  options.noise_px = 0.01;
  options.sigma_px = 0.5;
  const WindowWorld world = make_window_world(options, random);
  WindowDrive drive = WindowDrive::exact(6);
  drive.kept = KeyframeId(2);
  SlidingWindow window = drive_window(world, drive, 40);
  EXPECT_EQ(window.keyframes(), test::ids<KeyframeId>({2, 9, 10, 11, 12, 13}));
  const SlidingWindow batch = drive_window(world, WindowDrive::exact(100), 40);
  EXPECT_LT(distance_m(window.pose(KeyframeId(13)), batch.pose(KeyframeId(13))), 5e-6);
  const Matrix6d a = *relative_covariance(window, KeyframeId(2), KeyframeId(13)),
                 b = *relative_covariance(batch, KeyframeId(2), KeyframeId(13));
  EXPECT_LT((a - b).norm(), 0.02 * b.norm());
  window.keep(keyframe_variable(KeyframeId(2)), false);
  window.add_keyframe(KeyframeId(14), window.pose(KeyframeId(13)));
  EXPECT_EQ(window.marginalize(), test::ids<KeyframeId>({2}));
}

TEST(WindowLandmarks, RefuseWhatTheirContractExcludes) {
  SlidingWindow window({}, test::window_camera());
  window.add_keyframe(KeyframeId(5), SE3());
  window.add_landmark(LandmarkId(1), {0, 0, 5});
  window.add_line(LineId(2), Line3());
  window.add_plane(PlaneId(3), Plane3());
  const double nan = std::nan("");
  EXPECT_THROW(window.keep(keyframe_variable(KeyframeId(6))), ArgumentError);
  EXPECT_THROW(window.add_line(LineId(2), Line3()), ArgumentError);
  EXPECT_THROW(window.add_plane(PlaneId(3), Plane3()), ArgumentError);
  EXPECT_THROW(window.remove_line(LineId(7)), ArgumentError);
  EXPECT_THROW(window.add_line_observation({KeyframeId(6), LineId(2), {1, 2}, {3, 4}, 1}),
               ArgumentError);
  EXPECT_THROW(window.add_line_observation({KeyframeId(5), LineId(7), {1, 2}, {3, 4}, 1}),
               ArgumentError);
  EXPECT_THROW(window.add_line_observation({KeyframeId(5), LineId(2), {1, nan}, {3, 4}, 1}),
               ArgumentError);
  EXPECT_THROW(window.add_line_observation({KeyframeId(5), LineId(2), {1, 2}, {3, 4}, 0}),
               ArgumentError);
  window.add_line_observation({KeyframeId(5), LineId(2), {1, 2}, {3, 4}, 1});
  EXPECT_THROW(window.add_line_observation({KeyframeId(5), LineId(2), {1, 2}, {3, 4}, 1}),
               ArgumentError);
  EXPECT_THROW(add_height(window, {KeyframeId(5), PlaneId(7), 1.65, 0.1}), ArgumentError);
  EXPECT_THROW(add_height(window, {KeyframeId(6), PlaneId(3), 1.65, 0.1}), ArgumentError);
  EXPECT_THROW(add_height(window, {KeyframeId(5), PlaneId(3), -1.65, 0.1}), ArgumentError);
  EXPECT_THROW(add_height(window, {KeyframeId(5), PlaneId(3), 1.65, 0}), ArgumentError);
  EXPECT_THROW(window.add_plane_point({PlaneId(7), LandmarkId(1), 0.1}), ArgumentError);
  EXPECT_THROW(window.add_plane_point({PlaneId(3), LandmarkId(7), 0.1}), ArgumentError);
  EXPECT_THROW(window.add_plane_point({PlaneId(3), LandmarkId(1), 0}), ArgumentError);
  window.add_plane_point({PlaneId(3), LandmarkId(1), 0.1});
  EXPECT_THROW(window.add_plane_point({PlaneId(3), LandmarkId(1), 0.1}), ArgumentError);
  EXPECT_THROW(add_pose_prior(window, {KeyframeId(6), SE3(), Matrix6d::Identity()}), ArgumentError);
  EXPECT_THROW(add_pose_prior(window, {KeyframeId(5), SE3(), Matrix6d::Zero()}), ArgumentError);
  EXPECT_THROW(add_pose_prior(window, {KeyframeId(5), SE3(), -Matrix6d::Identity()}),
               ArgumentError);
  EXPECT_THROW(add_pose_prior(window, {KeyframeId(5), SE3(), nan * Matrix6d::Identity()}),
               ArgumentError);
  EXPECT_THROW((void)keyframe_covariance(window, KeyframeId(9)), ArgumentError);
  EXPECT_FALSE(window.line(LineId(8)));
  EXPECT_FALSE(window.plane(PlaneId(8)));
}

}  // namespace window_landmarks_test
}  // namespace placegraph
