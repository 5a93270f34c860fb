#include <gtest/gtest.h>
#include <placegraph/frontend/places/cues/gabor_statistics.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "tests/support/noise_image.h"

namespace placegraph {
namespace gabor_statistics_test {

int value(const CueGrid& grid, int x, int y, int channel) {
  return grid.values[(y * grid.columns + x) * grid.channels + channel];
}

TEST(GaborStatistics, MirrorWithTheImageAndHaveNoMeanInAnyScale) {
  const GaborOptions options;
  const int n = options.orientations, cells = options.cells;
  const Image image = test::noise_image(80, 60, CV_8UC1, 0.5, 3);
  Image mirrored;
  cv::flip(image, mirrored, 1);
  const CueGrid grid = gabor_cue(image), other = gabor_cue(mirrored);
  for (int first = 0; first < grid.channels; first += n) {
    int sum = 0;
    for (int y = 0; y < cells; ++y)
      for (int x = 0; x < cells; ++x)
        for (int k = 0; k < n; ++k) {
          sum += value(grid, x, y, first + k);
          // Smaller images are rounded to whole grey levels, of responses of some ten.
          EXPECT_NEAR(value(grid, x, y, first + k),
                      value(other, cells - 1 - x, y, first + (n - k) % n), 8);
        }
    EXPECT_LE(std::abs(sum), cells * cells * n / 2) << first;
  }
}

TEST(GaborStatistics, AreLargestAtTheOrientationOfAGratingOfEachScale) {
  const GaborOptions options;
  for (int scale = 0; scale < options.scales; ++scale)
    for (int k = 0; k < options.orientations; ++k) {
      const double angle = std::numbers::pi * k / options.orientations;
      const double frequency =
          2 * std::numbers::pi / (options.wavelength_px * std::pow(2.0, 0.5 * scale));
      cv::Mat grating(60, 80, CV_8UC1);
      for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 80; ++x)
          grating.at<uchar>(y, x) = static_cast<uchar>(
              128 + 90 * std::cos(frequency * (x * std::cos(angle) + y * std::sin(angle))));
      const CueGrid grid = gabor_cue(grating);
      const auto of_scale =
          grid.values.begin() + (1 * 4 + 2) * grid.channels + scale * options.orientations;
      EXPECT_EQ(std::max_element(of_scale, of_scale + options.orientations) - of_scale, k)
          << "scale " << scale;
    }
  EXPECT_THROW((void)gabor_cue(Image(60, 80, CV_8UC1), {.wavelength_px = 1.9}), ArgumentError);
}

}  // namespace gabor_statistics_test
}  // namespace placegraph
