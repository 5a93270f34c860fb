#include <gtest/gtest.h>
#include <placegraph/frontend/places/cues/gradient_layout.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "tests/support/noise_image.h"

namespace placegraph {
namespace gradient_layout_test {

int value(const CueGrid& grid, int x, int y, int channel) {
  return grid.values[(y * grid.columns + x) * grid.channels + channel];
}

TEST(GradientLayoutCue, TurnsAndMirrorsWithTheImage) {
  const GradientLayoutOptions options{.columns = 6, .cell_px = 8, .orientations = 8};
  const Image image = test::noise_image(48, 48, CV_8UC1, 2, 1);
  Image turned, mirrored, negative = 255 - image;
  cv::rotate(image, turned, cv::ROTATE_90_CLOCKWISE);
  cv::flip(image, mirrored, 1);
  const CueGrid grid = gradient_layout_cue(image, options),
                of_turned = gradient_layout_cue(turned, options),
                of_mirrored = gradient_layout_cue(mirrored, options);
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 6; ++x)
      for (int k = 0; k < 8; ++k) {
        // A right angle is four of eight orientations. Two units of 1023 for rounding.
        EXPECT_NEAR(value(of_turned, 5 - y, x, (k + 4) % 8), value(grid, x, y, k), 2);
        EXPECT_NEAR(value(of_mirrored, 5 - x, y, (8 - k) % 8), value(grid, x, y, k), 2);
        EXPECT_GE(value(grid, x, y, k), 0);
      }
  const CueGrid of_negative = gradient_layout_cue(negative, options);
  for (std::size_t i = 0; i < grid.values.size(); ++i)
    EXPECT_NEAR(of_negative.values[i], grid.values[i], 2);
}

TEST(GradientLayoutCue, SharesAnOrientationBetweenTheTwoNearest) {
  // Ramps whose gradient lies a quarter of the way from one of nine orientations to the next.
  Image ramp(96, 96, CV_8UC1);
  const double angle = 2.25 * std::numbers::pi / 9;
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x)
      ramp.at<uchar>(y, x) =
          static_cast<uchar>(std::lround(2 * (x * std::cos(angle) + y * std::sin(angle))) % 256);
  const CueGrid grid = gradient_layout_cue(ramp, {.columns = 12, .cell_px = 8, .orientations = 9});
  const int two = value(grid, 3, 3, 2), three = value(grid, 3, 3, 3);
  // Whole grey levels blur gradients of two levels a pixel by some degrees of the twenty of a bin.
  EXPECT_NEAR(three / static_cast<double>(two + three), 0.25, 0.1);
  for (const int k : {0, 5, 6, 7, 8}) EXPECT_LT(value(grid, 3, 3, k), 0.1 * two) << k;
}

}  // namespace gradient_layout_test
}  // namespace placegraph
