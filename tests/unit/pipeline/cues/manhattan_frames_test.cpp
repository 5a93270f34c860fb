#include <gtest/gtest.h>
#include <placegraph/frontend/vanishing/manhattan_frame.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/cues/manhattan_frames.h>

#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace manhattan_frames_test {

using test::make_window_world;
using test::WindowWorld;
using test::WindowWorldOptions;

const SO3 kR_map_manhattan = SO3::exp({0.05, 0.3, -0.02});

/// A rotation that maps axes to axes.
SO3 axes(int which) {
  SO3 R;
  for (int k = 0; k < which % 4; ++k) R = R * SO3::exp({0, 0, std::numbers::pi / 2});
  for (int k = 0; k < which % 3; ++k) R = R * SO3::exp({std::numbers::pi / 2, 0, 0});
  return R;
}

/// A stereo drive whose views are handed over one by one.
struct Drive {
  WindowWorld manhattan_frame;
  SlidingWindow window;
  ManhattanFrames manhattan_frames;
  Random random{5};
  std::int64_t next = 0;
  std::optional<SO3> R_map_first;  ///< the first world before the window was optimized last

  static WindowWorld make() {
    Random random(9);
    WindowWorldOptions options;
    options.keyframes = 14;
    options.landmarks = 60;
    options.stereo = true;
    return make_window_world(options, random);
  }
  static SlidingWindowOptions window_options() {
    SlidingWindowOptions options;
    options.max_keyframes = 6;
    options.hold_oldest = true;
    return options;
  }
  explicit Drive(const ManhattanFrameOptions& options)
      : manhattan_frame(make()),
        window(window_options(), manhattan_frame.camera),
        manhattan_frames(options) {}

  /// The next keyframe, which sees directions rotated from the first frame by `frame_rotation`.
  std::optional<ManhattanFrameId> see(const std::optional<SO3>& frame_rotation) {
    const std::int64_t id = next++;
    const SE3& T_map_cam = manhattan_frame.T_map_cam[static_cast<std::size_t>(id)];
    window.add_keyframe(KeyframeId(id), T_map_cam);
    add_view(window, manhattan_frame, KeyframeId(id), 0, random);
    std::optional<ManhattanFrameId> seen;
    if (frame_rotation)
      seen =
          manhattan_frames.add(KeyframeId(id),
                               T_map_cam.rotation().inverse() * kR_map_manhattan * *frame_rotation *
                                   axes(static_cast<int>(id)),
                               Eigen::Matrix3d::Identity() * std::pow(0.1 * kRadPerDeg, 2), window);
    if (window.manhattan_frame(ManhattanFrameId(1)))
      R_map_first = *window.manhattan_frame(ManhattanFrameId(1));
    if (id > 0) {
      EXPECT_TRUE(window.optimize().outcome);
    }
    window.marginalize();
    manhattan_frames.settle(window);
    return seen;
  }
};

TEST(ManhattanFrames, BeginWhereViewsAgreeWhicheverAxesTheyNameFirst) {
  Drive drive({});
  EXPECT_FALSE(drive.see(SO3()));
  EXPECT_FALSE(drive.see(SO3()));
  EXPECT_EQ(drive.see(SO3()), ManhattanFrameId(1));
  // It begins where the views have it: within what the poses of the window are off by.
  ASSERT_TRUE(drive.R_map_first);
  EXPECT_LT((kR_map_manhattan.inverse() * nearest_axes(*drive.R_map_first, kR_map_manhattan))
                .log()
                .norm(),
            0.1 * kRadPerDeg);
  for (int k = 3; k < 8; ++k) EXPECT_EQ(drive.see(SO3()), ManhattanFrameId(1));
  EXPECT_EQ(drive.window.manhattan_frames(),
            (std::vector{ManhattanFrames::kMapAxes, ManhattanFrameId(1)}));
  // Along the axes of the world, named as the first of the views named them.
  const SO3 frame_rotation =
      kR_map_manhattan.inverse() * *drive.window.manhattan_frame(ManhattanFrameId(1));
  EXPECT_LT((frame_rotation.matrix() - frame_rotation.matrix().array().round().matrix()).norm(),
            1e-6);
  // The map stays under them.
  EXPECT_LT(drive.window.manhattan_frame(ManhattanFrames::kMapAxes)->log().norm(), 1e-12);
  const auto expected = drive.manhattan_frames.expected(drive.window, KeyframeId(7));
  ASSERT_EQ(expected.size(), 1u);
  EXPECT_LT(std::sqrt(expected[0].covariance.trace()), 2 * kRadPerDeg);
}

TEST(ManhattanFrames, OfOtherDirectionsAreKeptApartAndFoundAgain) {
  Drive drive({});
  for (int k = 0; k < 4; ++k) (void)drive.see(SO3());
  const SO3 frame_rotation = SO3::exp({0, 10 * kRadPerDeg, 0});
  EXPECT_FALSE(drive.see(frame_rotation));
  EXPECT_FALSE(drive.see(frame_rotation));
  EXPECT_EQ(drive.see(frame_rotation), ManhattanFrameId(2));
  EXPECT_EQ(drive.see(frame_rotation), ManhattanFrameId(2));
  EXPECT_EQ(drive.see(SO3()), ManhattanFrameId(1));
  EXPECT_EQ(drive.window.manhattan_frames().size(), 3u);
}

TEST(ManhattanFrames, AStrayViewBeginsNone) {
  Drive drive({});
  for (int k = 0; k < 4; ++k) (void)drive.see(SO3());
  EXPECT_FALSE(drive.see(SO3::exp({0.3, 0.1, 0})));
  EXPECT_FALSE(drive.see(SO3::exp({0, -0.2, 0.1})));
  EXPECT_EQ(drive.see(SO3()), ManhattanFrameId(1));
  EXPECT_EQ(drive.window.manhattan_frames().size(), 2u);
}

TEST(ManhattanFrames, ViewsThatDisagreeBeginNone) {
  Drive drive({});
  EXPECT_FALSE(drive.see(SO3()));
  for (const double rotation_deg : {20, 40, -20, -40})
    EXPECT_FALSE(drive.see(SO3::exp({0, rotation_deg * kRadPerDeg, 0}))) << rotation_deg;
  EXPECT_TRUE(drive.window.manhattan_frames().empty());
}

TEST(ManhattanFrames, UnseenOnesAreRememberedUntilThereAreTooMany) {
  Drive drive({});
  for (int k = 0; k < 4; ++k) (void)drive.see(SO3());
  for (int k = 0; k < 8; ++k) (void)drive.see(std::nullopt);
  EXPECT_EQ(drive.see(SO3()), ManhattanFrameId(1));
  ManhattanFrameOptions options;
  options.max_count = 1;
  options.persistence = 2;
  Drive forgetful(options);
  for (int k = 0; k < 3; ++k) (void)forgetful.see(SO3());
  for (int k = 0; k < 8; ++k) (void)forgetful.see(SO3::exp({0, 20 * kRadPerDeg, 0}));
  EXPECT_EQ(forgetful.window.manhattan_frames(),
            (std::vector{ManhattanFrames::kMapAxes, ManhattanFrameId(2)}));
}

TEST(ManhattanFrames, FaultyOptionsAreRefused) {
  ManhattanFrameOptions options;
  options.correlation = 0;
  EXPECT_THROW(ManhattanFrames{options}, ArgumentError);
}

}  // namespace manhattan_frames_test
}  // namespace placegraph
