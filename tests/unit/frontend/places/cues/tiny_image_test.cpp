#include <gtest/gtest.h>
#include <placegraph/frontend/places/cues/tiny_image.h>

#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "tests/support/noise_image.h"

namespace placegraph {
namespace tiny_image_test {

int value(const CueGrid& grid, int x, int y, int channel) {
  return grid.values[(y * grid.columns + x) * grid.channels + channel];
}

TEST(GridSize, IsAWholeMultipleAndAtLeastOne) {
  const Image wide(60, 100, CV_8UC1);
  const auto size = [&](int columns, double scale, int multiple) {
    const GridSize found = grid_size(wide, columns, scale, multiple);
    return std::pair(found.columns, found.rows);
  };
  EXPECT_EQ(size(20, 1, 1), std::pair(20, 12));
  EXPECT_EQ(size(20, 0.5, 1), std::pair(10, 6));
  EXPECT_EQ(size(20, 0.8, 2), std::pair(16, 10));  // 9.6 rows
  EXPECT_EQ(size(21, 1, 4), std::pair(20, 12));    // 12.6 rows
  EXPECT_EQ(size(20, 0.01, 3), std::pair(3, 3));
}

TEST(TinyImageCue, HasNoMeanAndMirrorsWithTheImage) {
  const Image image = test::noise_image(160, 120, CV_8UC3, 2, 2);
  Image mirrored;
  cv::flip(image, mirrored, 1);
  const CueGrid grid = tiny_image_cue(image, 16), other = tiny_image_cue(mirrored, 16);
  ASSERT_EQ(grid.rows, 12);
  for (int c = 0; c < 3; ++c) {
    int sum = 0;
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 16; ++x) {
        sum += value(grid, x, y, c);
        EXPECT_NEAR(value(grid, x, y, c), value(other, 15 - x, y, c), 1);
      }
    EXPECT_LE(std::abs(sum), 16 * 12 / 2);  // half a unit for each rounding
  }
  for (const std::int16_t v :
       tiny_image_cue(Image(60, 80, CV_8UC3, cv::Scalar(9, 80, 7)), 8).values)
    EXPECT_EQ(v, 0);
}

}  // namespace tiny_image_test
}  // namespace placegraph
