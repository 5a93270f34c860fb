#include <gtest/gtest.h>
#include <placegraph/backend/window/window_problem.h>
#include <placegraph/backend/window/window_transform.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/window_factors.h"

namespace placegraph {
namespace window_transform_test {

using test::factors_of_every_kind;
using test::FactorScene;
using test::make_window_world;
using test::WindowDrive;
using test::WindowWorld;
using test::WindowWorldOptions;

/// Half the robust sum of squares of everything in a window; the window stays as it is.
double cost_of(WindowState state) {
  const WindowSummary summary = optimize_window(state);
  EXPECT_TRUE(summary.outcome) << summary.outcome.reason;
  return summary.cost_initial;
}

/// Noisy points with depths, lines, a ground with points on it and, but for `planes`, no plane in
/// the prior; a drive that is longer than the window, and one keyframe off its place.
WindowState driven_window(int planes) {
  Random random(61);
  WindowWorldOptions options;
  options.noise_px = 0.5;
  options.stereo = true;
  options.lines = 12;
  options.planes = planes;
  options.keyframes = 9;
  const WindowWorld world = make_window_world(options, random);
  WindowDrive drive;
  drive.options.max_keyframes = 5;
  WindowState state = drive_window(world, drive, 3).state();
  EXPECT_FALSE(state.prior.empty());
  EXPECT_EQ(state.prior.planes.size(), static_cast<std::size_t>(planes));
  SE3& T_map_cam = std::next(state.keyframes.begin())->second;
  T_map_cam = T_map_cam * SE3::exp((Vector6d() << 0.05, 0.02, -0.03, 0.01, 0, 0.01).finished());
  return state;
}

TEST(WindowTransform, MovesPointsLinesPlanesAndThePriorTogether) {
  WindowState state = driven_window(2);
  const double before = cost_of(state);
  ASSERT_GT(before, 10);
  move_window(state, SE3(SO3::exp({0.5, -0.4, 0.9}), Eigen::Vector3d(4, -7, 2)));
  // Rounding of what the large information of the prior weighs: 2e-8 where Clang compiles it.
  EXPECT_NEAR(cost_of(state), before, 1e-7 * before);
}

TEST(WindowTransform, RescalesPointsLinesDepthsAndThePriorTogether) {
  for (const double scale : {0.3, 4.0}) {
    WindowState state = driven_window(0);
    const double before = cost_of(state);
    ASSERT_GT(before, 10);
    const SE3 oldest = state.keyframes.begin()->second;
    rescale_window(state, scale);
    EXPECT_NEAR(cost_of(state), before, 1e-8 * before);
    EXPECT_LT(test::distance_m(state.keyframes.begin()->second, oldest), 1e-12);
  }
}

TEST(WindowTransform, RescalesPointsOnAPlaneAndHeightsAboveIt) {
  Random random(62);
  WindowWorldOptions options;
  options.noise_px = 0.5;
  options.ground_points = 30;
  options.sigma_height_m = 0.05;
  options.keyframes = 5;
  const WindowWorld world = make_window_world(options, random);
  WindowState state = drive_window(world, WindowDrive::exact(6), 4).state();
  state.keyframes.rbegin()->second =
      state.keyframes.rbegin()->second * SE3(SO3(), Eigen::Vector3d(0, 0.2, 0));
  const double before = cost_of(state);
  rescale_window(state, 2.5);
  EXPECT_NEAR(cost_of(state), before, 1e-8 * before);
}

TEST(WindowTransform, LeavesTheResidualOfEveryKindOfMeasurement) {
  const FactorScene scene;
  for (const auto& [name, factor] : factors_of_every_kind(scene)) {
    SlidingWindow window = scene.window({});
    window.add(factor);
    WindowState moved = window.state();
    const Eigen::VectorXd r = *residual(window.state(), factor);
    move_window(moved, SE3(SO3::exp({0.5, -0.4, 0.9}), Eigen::Vector3d(4, -7, 2)));
    EXPECT_LT((*residual(moved, moved.factors[0]) - r).norm(), 1e-9) << name;
    WindowState rescaled = moved;  // whose oldest keyframe is not the origin
    rescale_window(rescaled, 3);
    const double tolerance = name == "plane" ? 0.05 * r.norm() : 1e-9;  // first order of the error
    EXPECT_LT((*residual(rescaled, rescaled.factors[0]) - r).norm(), tolerance) << name;
  }
}

TEST(WindowTransform, RotatesAboutTheOldestKeyframeSoThatTheWorldLiesAsAsked) {
  const FactorScene scene;
  SlidingWindow window = scene.window({});
  WindowState state = window.state();
  state.keyframes.erase(KeyframeId(0));  // so that the oldest is not the origin
  const SO3 R_map_manhattan = SO3::exp({0.1, 0.2, 0.3});
  rotate_window(state, FactorScene::kManhattanFrame, R_map_manhattan);
  EXPECT_LT((state.manhattan_frames.at(FactorScene::kManhattanFrame).inverse() * R_map_manhattan)
                .log()
                .norm(),
            1e-12);
  EXPECT_LT(test::distance_m(state.keyframes.at(KeyframeId(1)), scene.T_map_cam[1]), 1e-12);
  const SE3 motion =
      state.keyframes.at(KeyframeId(1)).inverse() * state.keyframes.at(KeyframeId(3));
  EXPECT_LT((motion.inverse() * scene.motion(1, 3)).log().norm(), 1e-12);
}

TEST(WindowTransform, RefusesAScaleThatIsNoneAndAPriorOfPlanes) {
  WindowState state = driven_window(0);
  EXPECT_THROW(rescale_window(state, 0), ArgumentError);
  EXPECT_THROW(rescale_window(state, -1), ArgumentError);
  WindowState with_planes = driven_window(1);
  EXPECT_THROW(rescale_window(with_planes, 2), ArgumentError);
  WindowState empty;
  rescale_window(empty, 2);
  EXPECT_TRUE(empty.keyframes.empty());
}

}  // namespace window_transform_test
}  // namespace placegraph
