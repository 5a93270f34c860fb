#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>

#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace window_manhattan_test {

using test::angle_rad;
using test::distance_m;
using test::make_window_world;
using test::WindowDrive;
using test::WindowWorld;
using test::WindowWorldOptions;

const SO3 kR_map_manhattan = SO3::exp({0.1, 0.4, -0.2});

WindowWorldOptions stereo_world() {
  WindowWorldOptions options;
  options.keyframes = 12;
  options.landmarks = 48;
  options.noise_px = options.sigma_px = 0.5;
  options.stereo = true;
  return options;
}

struct Observations {
  double sigma_rad = 0.003;
  std::int64_t last = 100;  ///< keyframe that sees the world
  bool kept = false, held = false;
};

/// As drive_window, every keyframe seeing a world with noise of its own.
SlidingWindow drive(const WindowWorld& manhattan_frame, WindowDrive options,
                    const Observations& observations, double noise) {
  Random random(31);
  SlidingWindow window(options.options, manhattan_frame.camera);
  for (std::size_t k = 0; k < manhattan_frame.T_map_cam.size(); ++k) {
    const auto id = static_cast<std::int64_t>(k);
    SE3 T_map_cam = manhattan_frame.T_map_cam[k];
    if (k > 0)
      T_map_cam = window.pose(KeyframeId(id - 1)) *
                  (manhattan_frame.T_map_cam[k - 1].inverse() * manhattan_frame.T_map_cam[k]) *
                  test::random_motion(random, 0.02, 0.002);
    window.add_keyframe(KeyframeId(id), T_map_cam);
    add_view(window, manhattan_frame, KeyframeId(id), 1, random);
    if (k == 0) {
      window.add_manhattan_frame(ManhattanFrameId(7),
                                 kR_map_manhattan * SO3::exp({0.02, 0.01, -0.01}));
      window.keep(manhattan_variable(ManhattanFrameId(7)), observations.kept);
    }
    if (k == 1 && observations.held) window.hold_manhattan_frame(ManhattanFrameId(7));
    Eigen::Vector3d error;
    for (int i = 0; i < 3; ++i) error[i] = noise * observations.sigma_rad * random.normal();
    if (id <= observations.last)
      add_manhattan_observation(
          window,
          {KeyframeId(id), ManhattanFrameId(7),
           manhattan_frame.T_map_cam[k].rotation().inverse() * kR_map_manhattan * SO3::exp(error),
           Eigen::Matrix3d::Identity() / (observations.sigma_rad * observations.sigma_rad)});
    if (k > 0) {
      const WindowSummary summary = window.optimize();
      EXPECT_TRUE(summary.outcome) << summary.outcome.reason;
    }
    window.marginalize();
  }
  return window;
}

TEST(WindowWorlds, AreFoundWhereTheirObservationsSay) {
  Random random(41);
  WindowWorldOptions options = stereo_world();
  options.noise_px = 0;
  const WindowWorld manhattan_frame = make_window_world(options, random);
  const SlidingWindow window = drive(manhattan_frame, WindowDrive::exact(20), {}, 0);
  EXPECT_LT(
      (window.manhattan_frame(ManhattanFrameId(7))->inverse() * kR_map_manhattan).log().norm(),
      1e-6);
  EXPECT_LT(distance_m(window.pose(KeyframeId(11)), manhattan_frame.T_map_cam[11]), 1e-5);
}

TEST(WindowWorlds, LeaveTheSamePosesInThePriorAsInTheBatch) {
  Random random(42);
  WindowWorldOptions options = stereo_world();
  options.views_per_landmark = 4;
  options.noise_px = 0.01;
  const WindowWorld manhattan_frame = make_window_world(options, random);
  const Observations observations{3e-4, 100, true, false};
  const SlidingWindow window = drive(manhattan_frame, WindowDrive::exact(5), observations, 0.1);
  const SlidingWindow batch = drive(manhattan_frame, WindowDrive::exact(100), observations, 0.1);
  ASSERT_EQ(window.keyframes().size(), 5u);
  for (const KeyframeId id : window.keyframes()) {
    EXPECT_LT(distance_m(window.pose(id), batch.pose(id)), 1e-5);
    EXPECT_LT(angle_rad(window.pose(id), batch.pose(id)), 1e-6);
  }
  EXPECT_LT((window.manhattan_frame(ManhattanFrameId(7))->inverse() *
             *batch.manhattan_frame(ManhattanFrameId(7)))
                .log()
                .norm(),
            1e-6);
  const Matrix6d a = relative_information(window, KeyframeId(7), KeyframeId(9)),
                 b = relative_information(batch, KeyframeId(7), KeyframeId(9));
  EXPECT_LT((a - b).norm(), 0.02 * b.norm());
  const Eigen::Matrix3d p = *manhattan_covariance(window, ManhattanFrameId(7), KeyframeId(11)),
                        q = *manhattan_covariance(batch, ManhattanFrameId(7), KeyframeId(11));
  EXPECT_LT((p - q).norm(), 0.05 * q.norm());
}

TEST(WindowWorlds, AreKnownFromAHeldKeyframeAsItsObservationIs) {
  SlidingWindow window({}, test::window_camera());
  window.add_keyframe(KeyframeId(0), SE3());
  window.add_manhattan_frame(ManhattanFrameId(3), kR_map_manhattan);
  EXPECT_FALSE(manhattan_covariance(window, ManhattanFrameId(3), KeyframeId(0)));
  const Eigen::Vector3d information(1e4, 4e4, 9e4);
  add_manhattan_observation(
      window, {KeyframeId(0), ManhattanFrameId(3), kR_map_manhattan, information.asDiagonal()});
  const Eigen::Matrix3d covariance =
      *manhattan_covariance(window, ManhattanFrameId(3), KeyframeId(0));
  EXPECT_LT((covariance.diagonal() - information.cwiseInverse()).norm(), 1e-10);
  EXPECT_NEAR(covariance(0, 1), 0, 1e-12);
}

TEST(WindowWorlds, LeaveWithTheLastKeyframeThatSawThemUnlessTheyAreKept) {
  Random random(43);
  const WindowWorld manhattan_frame = make_window_world(stereo_world(), random);
  Observations observations;
  observations.last = 3;
  EXPECT_TRUE(
      drive(manhattan_frame, WindowDrive::exact(5), observations, 1).manhattan_frames().empty());
  observations.kept = true;
  SlidingWindow window = drive(manhattan_frame, WindowDrive::exact(5), observations, 1);
  EXPECT_EQ(window.manhattan_frames(), std::vector{ManhattanFrameId(7)});
  // Unseen for a while it is known less well than a keyframe that sees it knows it.
  const Eigen::Matrix3d unseen = *manhattan_covariance(window, ManhattanFrameId(7), KeyframeId(11));
  const SlidingWindow seen = drive(manhattan_frame, WindowDrive::exact(5), {}, 1);
  EXPECT_GT(unseen.trace(),
            manhattan_covariance(seen, ManhattanFrameId(7), KeyframeId(11))->trace());
  EXPECT_LT(std::sqrt(unseen.trace()), 0.03);
}

TEST(WindowWorlds, HoldingOneMovesTheWindowAsAWholeOnly) {
  Random random(44);
  const WindowWorld manhattan_frame = make_window_world(stereo_world(), random);
  for (const bool hold_oldest : {false, true}) {
    WindowDrive options = WindowDrive::exact(5);
    options.options.hold_oldest = hold_oldest;
    Observations observations;
    observations.kept = true;
    const SlidingWindow free = drive(manhattan_frame, options, observations, 1);
    observations.held = true;
    const SlidingWindow held = drive(manhattan_frame, options, observations, 1);
    const SE3 T_held_free = held.pose(KeyframeId(11)) * free.pose(KeyframeId(11)).inverse();
    EXPECT_GT(T_held_free.log().norm(), 1e-5);
    for (const KeyframeId id : held.keyframes())
      EXPECT_LT(distance_m(T_held_free * free.pose(id), held.pose(id)), 1e-4) << "keyframe " << id;
    // From the second keyframe on it was not moved.
    const SO3 R_map_manhattan = kR_map_manhattan * SO3::exp({0.02, 0.01, -0.01});
    EXPECT_LT((held.manhattan_frame(ManhattanFrameId(7))->inverse() * R_map_manhattan).log().norm(),
              1e-9);
  }
}

TEST(WindowWorlds, BoundTheDriftOfTheHeading) {
  // The rotation from the first to the last keyframe, over drives with and without a world.
  double with = 0, without = 0;
  for (int run = 0; run < 2; ++run) {
    Random random(50 + static_cast<std::uint64_t>(run));
    WindowWorldOptions options = stereo_world();
    options.keyframes = 20;
    options.landmarks = 64;
    const WindowWorld manhattan_frame = make_window_world(options, random);
    WindowDrive short_window = WindowDrive::exact(4);
    short_window.options.hold_oldest = true;
    const Observations seen{3e-4, 100, true, true};
    const auto error = [&](const SlidingWindow& window, const SO3& R_world) {
      const SO3 R = R_world.inverse() * window.pose(KeyframeId(19)).rotation();
      return (R.inverse() * kR_map_manhattan.inverse() * manhattan_frame.T_map_cam[19].rotation())
          .log()
          .squaredNorm();
    };
    const SlidingWindow a = drive(manhattan_frame, short_window, seen, 1);
    with += error(a, *a.manhattan_frame(ManhattanFrameId(7)));
    const SlidingWindow b = drive(manhattan_frame, short_window, {3e-4, -1, false, false}, 1);
    without += error(b, kR_map_manhattan);
  }
  EXPECT_LT(with, 0.2 * without);
}

TEST(WindowWorlds, FaultyOnesAreRefused) {
  SlidingWindow window({}, test::window_camera());
  window.add_keyframe(KeyframeId(0), SE3());
  window.add_manhattan_frame(ManhattanFrameId(1), SO3());
  EXPECT_THROW(window.add_manhattan_frame(ManhattanFrameId(1), SO3()), ArgumentError);
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  EXPECT_THROW(add_manhattan_observation(window, {KeyframeId(5), ManhattanFrameId(1), SO3(), I}),
               ArgumentError);
  EXPECT_THROW(add_manhattan_observation(window, {KeyframeId(0), ManhattanFrameId(2), SO3(), I}),
               ArgumentError);
  EXPECT_THROW(add_manhattan_observation(window, {KeyframeId(0), ManhattanFrameId(1), SO3(), -I}),
               ArgumentError);
  EXPECT_THROW(
      add_manhattan_observation(window, {KeyframeId(0), ManhattanFrameId(1), SO3(), 0 * I}),
      ArgumentError);
  EXPECT_THROW(window.keep(manhattan_variable(ManhattanFrameId(2))), ArgumentError);
  EXPECT_THROW(window.hold_manhattan_frame(ManhattanFrameId(2)), ArgumentError);
  EXPECT_FALSE(window.manhattan_frame(ManhattanFrameId(2)));
  EXPECT_EQ(window.manhattan_frames(), std::vector{ManhattanFrameId(1)});
}

}  // namespace window_manhattan_test
}  // namespace placegraph
