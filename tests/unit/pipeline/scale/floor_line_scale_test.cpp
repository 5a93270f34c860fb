#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/scale/floor_line_scale.h>

#include "tests/support/scenes/room_lines.h"

namespace placegraph {
namespace floor_line_scale_test {

using namespace test;

constexpr double kHeight_m = 1.4;  // of the corridor's camera above its floor

/// The lines of a corridor, seen and placed from its middle; lengths are `factor` times too short.
/// Ids begin with `first_id`.
std::vector<PlacedLine> corridor(double factor = 1, std::int64_t first_id = 0) {
  constexpr double kSigma = 2e-4;  // of their tangents
  const LineScene scene = corridor_lines();
  std::vector<PlacedLine> lines;
  for (std::size_t i = 0; i < scene.from.size(); ++i) {
    const auto start = scene.camera.project(scene.from[i]);
    const auto end = scene.camera.project(scene.to[i]);
    if (!start || !end) continue;
    const Eigen::Vector3d from = scene.from[i] / factor, to = scene.to[i] / factor;
    lines.push_back({LineId(first_id + static_cast<std::int64_t>(i)),
                     Line3::from_direction(from, to - from),
                     kSigma * kSigma * Eigen::Matrix4d::Identity(),
                     {*start, *end}});
  }
  return lines;
}
FloorLineScale scale(const FloorLineScaleOptions& options = {}) {
  return FloorLineScale(options, LineScene().camera, kHeight_m);
}

TEST(FloorLineScale, ThreeViewsThatAgreeGiveTheUnit) {
  FloorLineScale floor = scale();
  EXPECT_FALSE(floor.measure(SE3(), corridor(2.5), {}, false));
  EXPECT_FALSE(floor.measure(SE3(), corridor(2.55), {}, false));
  const auto length = floor.measure(SE3(), corridor(2.45), {}, false);
  ASSERT_TRUE(length);
  EXPECT_NEAR(length->factor, 2.5, 0.01);  // the one in the middle
  EXPECT_GE(length->sigma_relative, FloorLineScaleOptions().sigma_relative);
  EXPECT_LT(length->sigma_relative, FloorLineScaleOptions().max_sigma_at_first);
}

TEST(FloorLineScale, ViewsThatContradictEachOtherGiveNone) {
  FloorLineScale floor = scale();
  EXPECT_FALSE(floor.measure(SE3(), corridor(2.5), {}, false));
  EXPECT_FALSE(floor.measure(SE3(), corridor(3.5), {}, false));
  EXPECT_FALSE(floor.measure(SE3(), corridor(2.5), {}, false));
  // Only the last three count.
  EXPECT_FALSE(floor.measure(SE3(), corridor(2.5), {}, false));
  EXPECT_TRUE(floor.measure(SE3(), corridor(2.5), {}, false));
}

TEST(FloorLineScale, AHeightThatIsPoorlyKnownGivesNone) {
  FloorLineScaleOptions options;
  options.max_sigma_at_first = 0.9 * options.sigma_relative;  // no height is known so well
  FloorLineScale floor = scale(options);
  for (int i = 0; i < 4; ++i) EXPECT_FALSE(floor.measure(SE3(), corridor(2.5), {}, false)) << i;
  EXPECT_TRUE(
      floor.measure(SE3(), corridor(1), {}, true));  // in a known unit it may tell something
}

TEST(FloorLineScale, AtAKnownScaleALineIsUsedOnce) {
  FloorLineScale floor = scale();
  const auto first = floor.measure(SE3(), corridor(1.02), {}, true);
  ASSERT_TRUE(first);
  EXPECT_NEAR(first->factor, 1.02, 0.005);
  EXPECT_FALSE(floor.measure(SE3(), corridor(1.02), {}, true));      // nothing new of it
  EXPECT_TRUE(floor.measure(SE3(), corridor(1.02, 100), {}, true));  // other lines
}

TEST(FloorLineScale, FewNewLinesCountForLess) {
  FloorLineScale all = scale(), few = scale();
  ASSERT_TRUE(few.measure(SE3(), corridor(), {}, true));
  std::vector<PlacedLine> lines = corridor();
  int renamed = 0;  // two of the joints of the floor are new
  for (PlacedLine& line : lines)
    if (renamed < 2 && std::abs(line.line_ref.direction().x()) > 0.9 &&
        line.line_ref.nearest_point().y() > 1)
      line.id = LineId(line.id.value() + 1000), ++renamed;
  ASSERT_EQ(renamed, 2);
  const auto many = all.measure(SE3(), corridor(), {}, true),
             two = few.measure(SE3(), lines, {}, true);
  ASSERT_TRUE(many && two);
  EXPECT_GT(two->sigma_relative, 1.5 * many->sigma_relative);
}

TEST(FloorLineScale, AJumpIsNotAcceptedUntilItLasts) {
  FloorLineScale floor = scale();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(floor.measure(SE3(), corridor(1, 100 * i), {}, true));
  int refused = 0;
  while (refused < 10 && !floor.measure(SE3(), corridor(1.3, 1000 + 100 * refused), {}, true))
    ++refused;
  EXPECT_GE(refused, 2);  // shelves hide the floor for a moment
  EXPECT_LT(refused, 10);
}

TEST(FloorLineScale, WithoutAFloorThereIsNone) {
  std::vector<PlacedLine> ceiling = corridor();
  std::erase_if(ceiling, [](const PlacedLine& line) {
    return line.line_ref.nearest_point().y() > 0 || std::abs(line.line_ref.direction().y()) > 0.9;
  });
  FloorLineScale floor = scale();
  for (int i = 0; i < 4; ++i) EXPECT_FALSE(floor.measure(SE3(), ceiling, {}, i % 2 == 0));
}

TEST(FloorLineScale, AResetDropsAllMeasurements) {
  FloorLineScale floor = scale();
  ASSERT_TRUE(floor.measure(SE3(), corridor(), {}, true));
  floor.reset();
  EXPECT_TRUE(floor.measure(SE3(), corridor(), {}, true));
  EXPECT_FALSE(floor.measure(SE3(), corridor(2), {}, false));
  EXPECT_FALSE(floor.measure(SE3(), corridor(2), {}, false));
  floor.reset();
  EXPECT_FALSE(floor.measure(SE3(), corridor(2), {}, false));  // three views are needed again
}

TEST(FloorLineScale, LooksBackByAShareOfItsHeight) {
  EXPECT_NEAR(scale().min_baseline_m(), 0.6 * kHeight_m, 1e-12);
  EXPECT_THROW(FloorLineScale({}, LineScene().camera, 0), ArgumentError);
  FloorLineScaleOptions options;
  options.sigma_relative = -1;
  EXPECT_THROW(scale(options), ArgumentError);
}

}  // namespace floor_line_scale_test
}  // namespace placegraph
