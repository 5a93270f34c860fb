#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <ostream>

#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace window_consistency_test {

using test::drive_window;
using test::make_window_world;
using test::WindowDrive;
using test::WindowWorld;
using test::WindowWorldOptions;

constexpr int kRuns = 200;  ///< 50 would leave the 3 % below to chance
constexpr double kChi2Of6At99Percent = 16.8119;

/// A world and how it is driven through.
struct Case {
  const char* name;
  WindowWorldOptions world;
  std::optional<KeyframeId> kept = {};
  bool constrained_to_map = true;  ///< the prior leads back to the first keyframe
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

WindowWorldOptions noisy_world() {
  WindowWorldOptions world;
  world.keyframes = 12;
  world.landmarks = 70;
  world.noise_px = world.sigma_px = 0.5;
  return world;
}
WindowWorldOptions stereo() {
  WindowWorldOptions world = noisy_world();
  world.stereo = true;
  return world;
}
/// Tracks longer than the window: observations are dropped, never used twice, and with them the tie
/// to the first keyframe.
WindowWorldOptions long_tracks() {
  WindowWorldOptions world = stereo();
  world.views_per_landmark = 8;
  world.landmarks = 40;
  return world;
}
/// One eye; its scale comes from the ground under a camera of known height.
WindowWorldOptions mono_over_ground() {
  WindowWorldOptions world = noisy_world();
  world.ground_points = 30;
  world.sigma_height_m = 0.02;
  return world;
}
WindowWorldOptions stereo_with_lines() {
  WindowWorldOptions world = stereo();
  world.landmarks = 48;  // six in the first two keyframes, where lines do not count yet
  world.lines = 40;
  return world;
}

/// Three planes, which go into the prior.
WindowWorldOptions stereo_with_planes() {
  WindowWorldOptions world = stereo();
  world.planes = 3;
  return world;
}

/// Normalized squared error of an estimate, 6 degrees of freedom.
double nees(const SE3& estimate, const SE3& truth, const Matrix6d& covariance) {
  const Vector6d error = (estimate.inverse() * truth).log();
  return error.dot(covariance.llt().solve(error));
}

struct Statistics {
  double sum = 0;
  int above = 0;
  void add(double value) {
    sum += value;
    above += value > kChi2Of6At99Percent;
  }
  /// ANEES per degree of freedom in [0.5, 2], at most 3 % of the runs above the 99 % bound.
  void judge(const char* what) const {
    const double anees = sum / (6 * kRuns);
    std::cout << what << ": ANEES per degree of freedom " << anees << ", " << above << " of "
              << kRuns << " above the 99 % bound\n";
    EXPECT_GE(anees, 0.5) << what;
    EXPECT_LE(anees, 2.0) << what;
    EXPECT_LE(above, 0.03 * kRuns) << what;
  }
};

class WindowConsistency : public testing::TestWithParam<Case> {};

TEST_P(WindowConsistency, TheErrorsAreAsLargeAsTheCovariancesSay) {
  Statistics absolute, relative;
  for (int run = 0; run < kRuns; ++run) {
    const auto seed = static_cast<std::uint64_t>(1000 + run);
    Random random(seed);
    const WindowWorld world = make_window_world(GetParam().world, random);
    WindowDrive drive;
    drive.options.max_keyframes = 6;
    drive.options.huber_px = 50;  // the noise is normal
    drive.kept = GetParam().kept;
    const SlidingWindow window = drive_window(world, drive, seed + 1000000);
    const KeyframeId newest = window.keyframes().back();
    const KeyframeId reference = drive.kept.value_or(window.keyframes().front());
    const auto in_map = keyframe_covariance(window, newest);
    const auto to_reference = relative_covariance(window, reference, newest);
    ASSERT_TRUE(to_reference) << "seed " << seed;
    ASSERT_EQ(in_map.has_value(), GetParam().constrained_to_map) << "seed " << seed;
    const SE3& truth = world.T_map_cam[static_cast<std::size_t>(newest.value())];
    if (in_map) absolute.add(nees(window.pose(newest), truth, *in_map));
    relative.add(
        nees(window.pose(reference).inverse() * window.pose(newest),
             world.T_map_cam[static_cast<std::size_t>(reference.value())].inverse() * truth,
             *to_reference));
  }
  if (GetParam().constrained_to_map) absolute.judge("newest keyframe in the map");
  relative.judge("newest keyframe from the reference");
}

INSTANTIATE_TEST_SUITE_P(Of, WindowConsistency,
                         testing::Values(Case{"stereo", stereo()},
                                         Case{"stereo_long_tracks", long_tracks(), std::nullopt,
                                              false},
                                         Case{"stereo_with_lines", stereo_with_lines()},
                                         Case{"stereo_with_planes", stereo_with_planes()},
                                         Case{"stereo_from_a_kept_anchor", stereo(), KeyframeId(3)},
                                         Case{"mono_over_ground", mono_over_ground()}),
                         [](const auto& c) { return std::string(c.param.name); });

}  // namespace window_consistency_test
}  // namespace placegraph
