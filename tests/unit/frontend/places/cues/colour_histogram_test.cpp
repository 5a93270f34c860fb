#include <gtest/gtest.h>
#include <placegraph/frontend/places/cues/colour_histogram.h>
#include <placegraph/graph/core/random.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace colour_histogram_test {

/// An image of 80 x 60 pixels of one hue, as pure and bright as it can be.
Image of_hue(float degrees) {
  cv::Mat hsv(60, 80, CV_32FC3, cv::Scalar(static_cast<double>(degrees), 1, 1)), bgr;
  cv::cvtColor(hsv, bgr, cv::COLOR_HSV2BGR);
  bgr.convertTo(bgr, CV_8UC3, 255);
  return bgr;
}

double cosine(const Image& a, const Image& b, const ColourHistogramOptions& options) {
  return best_alignment(colour_histogram_cue(a, options), colour_histogram_cue(b, options), {});
}

TEST(ColourHistogramCue, HasCellsOfEqualLengthAndMirrorsWithTheImage) {
  Random random(1);
  cv::Mat image(60, 80, CV_8UC3), mirrored;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 240; ++x) image.ptr<uchar>(y)[x] = static_cast<uchar>(random.index(256));
  cv::flip(image, mirrored, 1);
  const ColourHistogramOptions options{.cells = 3, .hues = 5, .saturations = 2, .values = 3};
  const CueGrid grid = colour_histogram_cue(image, options),
                other = colour_histogram_cue(mirrored, options);
  ASSERT_EQ(grid.channels, 5 * 2 * 3);
  const auto square_of = [&](int x, int y) {
    return static_cast<double>(grid.energy[(y + 1) * 4 + x + 1] - grid.energy[y * 4 + x + 1] -
                               grid.energy[(y + 1) * 4 + x] + grid.energy[y * 4 + x]);
  };
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) {
      // Roots of shares that sum to one. 30 values rounded by up to half a unit of a thousand.
      EXPECT_NEAR(square_of(x, y) / square_of(0, 0), 1, 0.01);
      for (int c = 0; c < grid.channels; ++c)
        EXPECT_NEAR(grid.values[(y * 3 + x) * grid.channels + c],
                    other.values[(y * 3 + 2 - x) * grid.channels + c], 1);
    }
}

TEST(ColourHistogramCue, HasTheBhattacharyyaCoefficientAsCosine) {
  // The upper rows of one image have another colour. With a single cell a row counts by one minus
  // its distance from the middle, in heights of the image.
  const ColourHistogramOptions options{.cells = 1};
  const Image red = of_hue(11.25f);
  for (const int rows : {7, 20, 30, 51}) {
    Image other = red.clone();
    of_hue(191.25f).rowRange(0, rows).copyTo(other.rowRange(0, rows));
    double all = 0, same = 0;
    for (int y = 0; y < 60; ++y) {
      const double share = 1 - std::abs((y + 0.5) / 60 - 0.5);
      all += share;
      if (y >= rows) same += share;
    }
    EXPECT_NEAR(cosine(red, other, options), std::sqrt(same / all), 2e-3) << rows;
  }
}

TEST(ColourHistogramCue, SharesAHueBetweenTheTwoNearestBinsAllAround) {
  // Bins of 24 degrees with centres at 12, 36, ... 348; the last is beside the first. All these
  // hues are whole levels of eight bits, 4 / 17 degrees each.
  const ColourHistogramOptions options{.cells = 1, .hues = 15};
  for (const float centre : {12.0f, 108.0f, 348.0f})
    for (const int thirds : {1, 2}) {
      const double share = thirds / 3.0;
      const Image between = of_hue(std::fmod(centre + 8.0f * static_cast<float>(thirds), 360.0f));
      // Rounding a hue by 1e-5 of a bin moves that share, and the cosine by its root.
      EXPECT_NEAR(cosine(of_hue(centre), between, options), std::sqrt(1 - share), 5e-3) << centre;
      EXPECT_NEAR(cosine(of_hue(std::fmod(centre + 24, 360.0f)), between, options),
                  std::sqrt(share), 5e-3)
          << centre;
    }
}

TEST(ColourHistogramCue, IsTheSameForALargerImage) {
  Image image = of_hue(40), large;
  of_hue(200).colRange(0, 32).copyTo(image.colRange(0, 32));
  cv::resize(image, large, {240, 180}, 0, 0, cv::INTER_NEAREST);
  EXPECT_EQ(colour_histogram_cue(large).values, colour_histogram_cue(image).values);
}

}  // namespace colour_histogram_test
}  // namespace placegraph
