#include <gtest/gtest.h>

#include <vector>

#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace window_determinism_test {

using test::drive_window;
using test::make_window_world;
using test::WindowDrive;
using test::WindowWorld;
using test::WindowWorldOptions;

/// Blocks of many sizes, every other one given back: what is allocated next lies anywhere between.
std::vector<std::vector<char>> scattered_heap(Random& random) {
  std::vector<std::vector<char>> blocks(400);
  for (auto& block : blocks) block.resize(static_cast<std::size_t>(16 + random.index(5984)));
  for (auto& block : blocks)
    if (random.index(2) == 0) std::vector<char>().swap(block);
  return blocks;
}

TEST(WindowDeterminism, TheSameBitsComeFromAnyLayoutOfTheHeap) {
  // Points, lines and planes: the solver orders what it eliminates together by address.
  WindowWorldOptions options;
  options.keyframes = 10;
  options.landmarks = 60;
  options.stereo = true;
  options.noise_px = 0.7;
  options.lines = 12;
  options.planes = 2;
  Random world_random(11);
  const WindowWorld world = make_window_world(options, world_random);
  WindowDrive drive;
  drive.options.max_keyframes = 5;
  const SlidingWindow first = drive_window(world, drive, 3);
  ASSERT_FALSE(first.lines().empty());
  Random random(12);
  for (int layout = 0; layout < 8; ++layout) {
    const std::vector<std::vector<char>> held = scattered_heap(random);
    const SlidingWindow window = drive_window(world, drive, 3);
    ASSERT_EQ(first.keyframes(), window.keyframes());
    for (const KeyframeId id : first.keyframes())
      EXPECT_EQ(first.pose(id).matrix(), window.pose(id).matrix()) << "layout " << layout;
    for (const LandmarkId id : first.landmarks())
      EXPECT_EQ(*first.landmark(id), *window.landmark(id)) << "layout " << layout;
    EXPECT_EQ(relative_information(first, KeyframeId(7), KeyframeId(9)),
              relative_information(window, KeyframeId(7), KeyframeId(9)));
  }
}

}  // namespace window_determinism_test
}  // namespace placegraph
