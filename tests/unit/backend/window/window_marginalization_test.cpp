#include <gtest/gtest.h>
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Eigenvalues>

#include "tests/support/ids.h"
#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace window_marginalization_test {

using test::angle_rad;
using test::distance_m;
using test::make_window_world;
using test::WindowWorld;
using test::WindowWorldOptions;

SlidingWindow drive(const WindowWorld& manhattan_frame, int max_keyframes, std::uint64_t seed,
                    double disturbance = 1) {
  test::WindowDrive how = test::WindowDrive::exact(max_keyframes);
  how.disturbance = disturbance;
  return test::drive_window(manhattan_frame, how, seed);
}

WindowWorldOptions stereo_world(double noise_px) {
  WindowWorldOptions options;
  options.keyframes = 12;
  options.landmarks = 150;
  options.views_per_landmark = 4;
  options.stereo = true;
  options.noise_px = noise_px;
  options.sigma_px = 0.5;
  return options;
}

TEST(WindowMarginalization, GivesTheSameNewestPosesAsTheWholeBatch) {
  Random random(1);
  // Tracks of four views in a window of five: no observation is dropped, so that only the
  // linearization tells the two apart. It is quadratic in the noise.
  const WindowWorld manhattan_frame = make_window_world(stereo_world(0.01), random);
  const SlidingWindow window = drive(manhattan_frame, 5, 2);
  const SlidingWindow batch = drive(manhattan_frame, 100, 2);
  ASSERT_EQ(window.keyframes(), test::ids<KeyframeId>({7, 8, 9, 10, 11}));
  ASSERT_EQ(batch.keyframes().size(), 12u);
  EXPECT_GT(distance_m(batch.pose(KeyframeId(11)), manhattan_frame.T_map_cam[11]),
            5e-5);  // the noise is felt
  for (const KeyframeId id : window.keyframes()) {
    EXPECT_LT(distance_m(window.pose(id), batch.pose(id)), 2e-6);
    EXPECT_LT(angle_rad(window.pose(id), batch.pose(id)), 2e-7);
  }
  const Matrix6d a = relative_information(window, KeyframeId(8), KeyframeId(11)),
                 b = relative_information(batch, KeyframeId(8), KeyframeId(11));
  EXPECT_LT((a - b).norm(), 0.02 * b.norm());
}

TEST(WindowMarginalization, KeepsGaugeAndScaleOfAnExactDrive) {
  Random random(3);
  WindowWorldOptions options = stereo_world(0);
  const WindowWorld stereo = make_window_world(options, random);
  const SlidingWindow window = drive(stereo, 5, 4);
  for (const KeyframeId id : window.keyframes())
    EXPECT_LT(distance_m(window.pose(id), stereo.T_map_cam[static_cast<std::size_t>(id.value())]),
              1e-6);
}

TEST(WindowMarginalization, HoldsTheScaleOfAMonoDriveThroughThePrior) {
  Random random(5);
  WindowWorldOptions options = stereo_world(0);
  options.stereo = false;
  const WindowWorld manhattan_frame = make_window_world(options, random);
  const SlidingWindow window = drive(manhattan_frame, 5, 6, 0.2);
  // The scale is that of the disturbed start: read it off one pair, check the others.
  const auto length_m = [&](std::int64_t a, std::int64_t b) {
    return distance_m(window.pose(KeyframeId(a)), window.pose(KeyframeId(b))) /
           distance_m(manhattan_frame.T_map_cam[static_cast<std::size_t>(a)],
                      manhattan_frame.T_map_cam[static_cast<std::size_t>(b)]);
  };
  const double scale = length_m(7, 8);
  EXPECT_NEAR(scale, 1, 0.02);
  for (std::int64_t id = 9; id < 12; ++id) EXPECT_NEAR(length_m(7, id), scale, 1e-6);
  // Position of the first keyframe, fixed and gone: the path still starts there.
  EXPECT_LT((window.pose(KeyframeId(11)).translation() -
             scale * manhattan_frame.T_map_cam[11].translation())
                .norm(),
            1e-5);
}

TEST(WindowMarginalization, TakesTheOldestAndWhatOnlyItAndOthersButTheNewestSaw) {
  Random random(7);
  WindowWorldOptions options = stereo_world(0);
  options.keyframes = 5;
  options.views_per_landmark = 3;
  options.landmarks = 60;  // first seen in 0, 1, 2 by turns
  const WindowWorld manhattan_frame = make_window_world(options, random);
  SlidingWindowOptions window_options;
  window_options.max_keyframes = 4;
  SlidingWindow window(window_options, manhattan_frame.camera);
  fill_window(window, manhattan_frame, random, 0, 0, 0);
  // Landmark 0 (keyframes 0 to 2) is seen by the newest too: it stays, without its oldest view.
  const Eigen::Vector3d p_cam = manhattan_frame.T_map_cam[4].inverse() * manhattan_frame.points[0];
  window.add_observation(
      {KeyframeId(4), LandmarkId(0), *manhattan_frame.camera.project(p_cam), 1, {}, 1});
  EXPECT_EQ(window.marginalize(), test::ids<KeyframeId>({0}));
  EXPECT_EQ(window.keyframes(), test::ids<KeyframeId>({1, 2, 3, 4}));
  EXPECT_EQ(window.observations(LandmarkId(0)).size(), 3u);
  EXPECT_EQ(window.observations(LandmarkId(0)).front().keyframe, KeyframeId(1));
  for (std::int64_t id = 1; id < 60; ++id)
    EXPECT_EQ(window.landmark(LandmarkId(id)).has_value(), id % 3 != 0) << id;
  EXPECT_TRUE(window.marginalize().empty());
}

TEST(WindowMarginalization, TheInformationOfADriveIsNotMoreThanThatOfItsBatch) {
  Random random(8);
  WindowWorldOptions options = stereo_world(0.5);
  options.views_per_landmark = 6;  // longer than the window: observations are dropped
  const WindowWorld manhattan_frame = make_window_world(options, random);
  const Matrix6d window =
      relative_information(drive(manhattan_frame, 4, 9), KeyframeId(9), KeyframeId(11));
  const Matrix6d batch =
      relative_information(drive(manhattan_frame, 100, 9), KeyframeId(9), KeyframeId(11));
  // Largest generalized eigenvalue <= 1, but for the difference of the linearization points.
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6d> eigen(window, batch);
  EXPECT_LT(eigen.eigenvalues()[5], 1.05);
  EXPECT_GT(eigen.eigenvalues()[0], 0.05);
}

TEST(WindowMarginalization, HoldsTheOldestKeyframeWhereThePriorIsEmpty) {
  Random random(14);
  for (const bool stereo : {true, false}) {
    WindowWorldOptions options;
    options.keyframes = options.views_per_landmark = 6;  // all points are seen in all keyframes
    options.stereo = stereo;
    const WindowWorld manhattan_frame = make_window_world(options, random);
    const SlidingWindow window = drive(manhattan_frame, 4, 15, 0.2);
    ASSERT_EQ(window.keyframes().front(), KeyframeId(2));
    EXPECT_LT(distance_m(window.pose(KeyframeId(5)), manhattan_frame.T_map_cam[5]),
              stereo ? 1e-6 : 0.1);
    // Optimizing again moves nothing: gauge and scale are held.
    SlidingWindow again = drive(manhattan_frame, 4, 15, 0.2);
    ASSERT_TRUE(again.optimize().outcome);
    for (const KeyframeId id : window.keyframes())
      EXPECT_LT(distance_m(window.pose(id), again.pose(id)), 1e-6);
  }
}

TEST(WindowMarginalization, OfKeyframesWithoutObservationsLeavesNoNaN) {
  SlidingWindowOptions options;
  options.max_keyframes = 2;
  SlidingWindow window(options, test::window_camera());
  for (int k = 0; k < 5; ++k)
    window.add_keyframe(KeyframeId(k), SE3(SO3(), Eigen::Vector3d(0, 0, k)));
  EXPECT_EQ(window.marginalize().size(), 3u);
  EXPECT_EQ(window.optimize().outcome.code, Outcome::Code::kTooFewData);
  EXPECT_TRUE(window.pose(KeyframeId(4)).matrix().allFinite());
  EXPECT_TRUE(relative_information(window, KeyframeId(3), KeyframeId(4)).allFinite());
}

TEST(WindowHoldOldest, GivesTheSameMotionsAsTheWholeBatch) {
  Random random(1);
  const WindowWorld manhattan_frame = make_window_world(stereo_world(0.01), random);
  test::WindowDrive how = test::WindowDrive::exact(5);
  how.options.hold_oldest = true;
  const SlidingWindow window = test::drive_window(manhattan_frame, how, 2);
  const SlidingWindow batch = drive(manhattan_frame, 100, 2);
  const auto motion = [](const SlidingWindow& w, std::int64_t a, std::int64_t b) {
    return w.pose(KeyframeId(a)).inverse() * w.pose(KeyframeId(b));
  };
  for (const std::int64_t id : {8, 9, 10, 11}) {
    EXPECT_LT(distance_m(motion(window, 7, id), motion(batch, 7, id)), 2e-6);
    EXPECT_LT(angle_rad(motion(window, 7, id), motion(batch, 7, id)), 2e-7);
  }
  const Matrix6d a = relative_information(window, KeyframeId(8), KeyframeId(11)),
                 b = relative_information(batch, KeyframeId(8), KeyframeId(11));
  EXPECT_LT((a - b).norm(), 0.02 * b.norm());
}

TEST(WindowHoldOldest, LeavesTheOldestKeyframeWhereItIs) {
  Random random(4);
  const WindowWorld manhattan_frame = make_window_world(stereo_world(0.5), random);
  test::WindowDrive how = test::WindowDrive::exact(4);
  how.options.hold_oldest = true;
  WindowWorld part = manhattan_frame;  // all but the last keyframe, then that one
  part.T_map_cam.pop_back();
  SlidingWindow window = test::drive_window(part, how, 2);
  const SE3 before = window.pose(window.keyframes().front());
  const KeyframeId oldest = window.keyframes().front(), last = window.keyframes().back(),
                   next = ++KeyframeId(last);
  window.add_keyframe(next, window.pose(last) * (manhattan_frame.T_map_cam[10].inverse() *
                                                 manhattan_frame.T_map_cam[11]));
  test::add_view(window, manhattan_frame, next, 1, random);
  ASSERT_TRUE(window.optimize().outcome);
  EXPECT_EQ(distance_m(window.pose(oldest), before), 0);
  EXPECT_GT(relative_information(window, oldest, next).trace(), 0);
}

/// Length of the newest step over its true one, after a drive whose measured distances grow by a
/// tenth half-way, as where a single eye's unit has crept.
double newest_step(const WindowWorld& manhattan_frame, double scale_drift) {
  Random random(9);
  test::WindowDrive how = test::WindowDrive::exact(5);
  how.options.scale_drift = scale_drift;
  SlidingWindow window(how.options, manhattan_frame.camera);
  const auto true_pose = [&](std::int64_t id) {
    return manhattan_frame.T_map_cam[static_cast<std::size_t>(id)];
  };
  const auto last = static_cast<std::int64_t>(manhattan_frame.T_map_cam.size()) - 1;
  for (std::int64_t id = 0; id <= last; ++id) {
    window.add_keyframe(KeyframeId(id), id == 0
                                            ? true_pose(0)
                                            : window.pose(KeyframeId(id - 1)) *
                                                  (true_pose(id - 1).inverse() * true_pose(id)));
    test::add_view(window, manhattan_frame, KeyframeId(id), 0, random);
    if (id > 0) {
      const double truth_m = distance_m(true_pose(id - 1), true_pose(id));
      add_distance(window, {KeyframeId(id - 1), KeyframeId(id), (id < last / 2 ? 1 : 1.1) * truth_m,
                            0.05 * truth_m});
      EXPECT_TRUE(window.optimize().outcome);
    }
    window.marginalize();
  }
  return distance_m(window.pose(KeyframeId(last - 1)), window.pose(KeyframeId(last))) /
         distance_m(true_pose(last - 1), true_pose(last));
}

TEST(WindowScaleDrift, APriorWhoseUnitMayWanderFollowsTheDistancesOfNow) {
  Random random(8);
  WindowWorldOptions options = stereo_world(0.05);
  options.sigma_px = 0.05;
  options.stereo = false;
  options.keyframes = 24;
  options.landmarks = 400;
  const WindowWorld manhattan_frame = make_window_world(options, random);
  const double stiff = newest_step(manhattan_frame, 0), free = newest_step(manhattan_frame, 0.02);
  // Points followed from one half into the other keep the old unit in the stiff window.
  EXPECT_LT(stiff, 1.08);
  EXPECT_GT(free, stiff + 0.01);
  EXPECT_NEAR(free, 1.1, 0.02);
}

TEST(WindowScaleDrift, DoesNotMoveAnExactDrive) {
  Random random(3);
  const WindowWorld stereo = make_window_world(stereo_world(0), random);
  test::WindowDrive how = test::WindowDrive::exact(5);
  how.options.scale_drift = 0.05;
  const SlidingWindow window = test::drive_window(stereo, how, 4);
  for (const KeyframeId id : window.keyframes())
    EXPECT_LT(distance_m(window.pose(id), stereo.T_map_cam[static_cast<std::size_t>(id.value())]),
              1e-6);
}

TEST(WindowRescale, MovesEverythingAboutTheOldestKeyframeAndKeepsTheCost) {
  Random random(10);
  WindowWorldOptions options = stereo_world(0.3);
  options.stereo = false;
  const WindowWorld manhattan_frame = make_window_world(options, random);
  SlidingWindow window = drive(manhattan_frame, 5, 11, 0.2);
  const double cost = window.optimize().cost_final;
  const SE3 oldest = window.pose(KeyframeId(7));
  const double length_m = distance_m(oldest, window.pose(KeyframeId(11)));
  const LandmarkId landmark = window.landmarks().front();
  const Eigen::Vector3d offset_map = *window.landmark(landmark) - oldest.translation();
  window.rescale(2.5);
  EXPECT_EQ(distance_m(oldest, window.pose(KeyframeId(7))), 0);
  EXPECT_NEAR(distance_m(oldest, window.pose(KeyframeId(11))), 2.5 * length_m, 1e-9);
  EXPECT_LT((*window.landmark(landmark) - oldest.translation() - 2.5 * offset_map).norm(), 1e-9);
  const WindowSummary summary = window.optimize();
  EXPECT_NEAR(summary.cost_initial, cost, 1e-6 * cost);
  EXPECT_NEAR(distance_m(window.pose(KeyframeId(7)), window.pose(KeyframeId(11))), 2.5 * length_m,
              1e-3 * length_m);
}

TEST(WindowRescale, IsRefusedOnceTheScaleIsMeasured) {
  Random random(12);
  WindowWorldOptions options = stereo_world(0);
  const WindowWorld stereo = make_window_world(options, random);
  SlidingWindow window = drive(stereo, 5, 13);
  EXPECT_THROW(window.rescale(2), ArgumentError);
  options.stereo = false;
  const WindowWorld mono = make_window_world(options, random);
  SlidingWindow measured = drive(mono, 5, 13, 0);
  EXPECT_THROW(measured.rescale(0), ArgumentError);
  add_distance(measured, {KeyframeId(10), KeyframeId(11), 1, 0.1});
  EXPECT_THROW(measured.rescale(2), ArgumentError);
}

}  // namespace window_marginalization_test
}  // namespace placegraph
