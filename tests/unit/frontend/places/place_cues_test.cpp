#include <gtest/gtest.h>
#include <placegraph/frontend/places/cues/colour_histogram.h>
#include <placegraph/frontend/places/cues/corner_agreement.h>
#include <placegraph/frontend/places/cues/cue_grid.h>
#include <placegraph/frontend/places/cues/gabor_statistics.h>
#include <placegraph/frontend/places/cues/gradient_layout.h>
#include <placegraph/frontend/places/cues/tiny_image.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace place_cues_test {

Image random_image(int width, int height, int channels, std::uint64_t seed) {
  Random random(seed, 0);
  cv::Mat coarse(height / 10, width / 10, channels == 3 ? CV_8UC3 : CV_8UC1), image;
  for (int y = 0; y < coarse.rows; ++y)
    for (int i = 0; i < coarse.cols * channels; ++i)
      coarse.ptr<uchar>(y)[i] = static_cast<uchar>(random.uniform(20, 230));
  cv::resize(coarse, image, {width, height}, 0, 0, cv::INTER_NEAREST);
  return image;
}

Image shifted(const Image& image, int x, int y) {
  const cv::Mat motion = (cv::Mat_<double>(2, 3) << 1, 0, x, 0, 1, y);
  cv::Mat moved;
  cv::warpAffine(image, moved, motion, image.size(), cv::INTER_LINEAR, cv::BORDER_REFLECT);
  return moved;
}

TEST(CueGrid, GivesTheCosineOfEqualGridsAndOfShiftedOnes) {
  const CueGrid a = make_cue_grid(3, 1, 1, {0, 1, 2});
  const CueGrid b = make_cue_grid(3, 1, 1, {1, 2, 0});
  EXPECT_NEAR(best_alignment(a, a, {}), 1, 1e-3);
  EXPECT_NEAR(best_alignment(a, b, {}), 2.0 / 5, 1e-3);
  // One cell to the left, 1 and 2 lie upon 1 and 2; a third of b lies outside.
  EXPECT_NEAR(best_alignment(a, b, {.shift_x = 1}), 1, 1e-3);
  EXPECT_NEAR(best_alignment(a, b, {.shift_x = 1, .loss = 0.3}), 0.9, 1e-3);
}

TEST(CueGrid, LooksOnlyWhereEnoughOverlaps) {
  const CueGrid wide = make_cue_grid(10, 1, 1, std::vector<float>(10, 1));
  const CueGrid narrow = make_cue_grid(2, 1, 1, {1, 1});
  EXPECT_DOUBLE_EQ(best_alignment(narrow, wide, {}), -1);
  EXPECT_NEAR(best_alignment(narrow, wide, {.min_overlap = 0.1}), 1, 1e-3);
  const CueGrid blank = make_cue_grid(2, 1, 1, {0, 0});
  EXPECT_DOUBLE_EQ(best_alignment(blank, narrow, {}), 0);
}

TEST(CueGrid, FindsTheSameBestShiftInStepsOnASmoothGrid) {
  std::vector<float> a, b;
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 20; ++x) {
      const auto wave = [&](int u, int v) {
        return static_cast<float>(std::sin(0.35 * u) + std::cos(0.4 * v + 0.1 * u));
      };
      a.push_back(wave(x, y));
      b.push_back(wave(x + 3, y - 1));
    }
  const CueGrid from = make_cue_grid(20, 12, 1, a), to = make_cue_grid(20, 12, 1, b);
  const GridSearch every{.shift_x = 5, .shift_y = 3};
  GridSearch stepped = every;
  stepped.step = 2;
  EXPECT_NEAR(best_alignment(from, to, every), 1, 1e-3);
  EXPECT_DOUBLE_EQ(best_alignment(from, to, stepped), best_alignment(from, to, every));
}

TEST(CueGrid, RefusesWhatIsNoGrid) {
  EXPECT_THROW((void)make_cue_grid(2, 1, 1, {1}), ArgumentError);
  EXPECT_THROW((void)make_cue_grid(1, 1, 1, {std::nanf("")}), ArgumentError);
  const CueGrid one = make_cue_grid(1, 1, 1, {1}), two = make_cue_grid(1, 1, 2, {1, 1});
  EXPECT_THROW((void)best_alignment(one, two, {}), ArgumentError);
}

TEST(TinyImage, ForgetsBrightnessAndContrast) {
  const Image image = random_image(240, 180, 1, 1);
  Image darker;
  image.convertTo(darker, -1, 0.5, 10);
  EXPECT_GT(best_alignment(tiny_image_cue(darker, 24), tiny_image_cue(image, 24), {}), 0.99);
  EXPECT_LT(best_alignment(tiny_image_cue(random_image(240, 180, 1, 2), 24),
                           tiny_image_cue(image, 24), {}),
            0.4);
}

TEST(TinyImage, FollowsTheShapeOfTheImageAndItsScale) {
  const CueGrid grid = tiny_image_cue(random_image(320, 240, 3, 1), 24);
  EXPECT_EQ(grid.columns, 24);
  EXPECT_EQ(grid.rows, 18);
  EXPECT_EQ(grid.channels, 3);
  const CueGrid small = tiny_image_cue(random_image(320, 240, 1, 1), 24, 0.8);
  EXPECT_EQ(small.columns, 20);
  EXPECT_EQ(small.rows, 14);
  EXPECT_EQ(small.channels, 1);
  EXPECT_THROW((void)tiny_image_cue(Image(10, 10, CV_32FC1), 24), ArgumentError);
}

TEST(TinyImage, FindsAShiftedAndAZoomedView) {
  const Image image = random_image(320, 240, 3, 3);
  const CueGrid stored = tiny_image_cue(image, 24);
  const GridSearch search{.shift_x = 6, .shift_y = 4};
  EXPECT_GT(best_alignment(tiny_image_cue(shifted(image, 40, 0), 24), stored, search), 0.9);
  // The middle four fifths, as seen from nearer: at 0.8 its cells lie upon the stored ones.
  Image nearer;
  cv::resize(image(cv::Rect(32, 24, 256, 192)), nearer, image.size(), 0, 0, cv::INTER_LINEAR);
  EXPECT_GT(best_alignment(tiny_image_cue(nearer, 24, 0.8), stored, search),
            best_alignment(tiny_image_cue(nearer, 24), stored, search) + 0.1);
}

TEST(ColourHistogram, CountsEachCellToOne) {
  const Image red(60, 80, CV_8UC3, cv::Scalar(0, 0, 255));
  const Image blue(60, 80, CV_8UC3, cv::Scalar(255, 0, 0));
  const CueGrid a = colour_histogram_cue(red), b = colour_histogram_cue(blue);
  EXPECT_EQ(a.channels, 256);
  EXPECT_NEAR(best_alignment(a, a, {}), 1, 1e-3);
  EXPECT_NEAR(best_alignment(a, b, {}), 0, 1e-3);
  Image half = red.clone();
  blue.colRange(40, 80).copyTo(half.colRange(40, 80));
  // Half of the cells are the same, but for the pixels about the middle that count for both.
  EXPECT_NEAR(best_alignment(a, colour_histogram_cue(half), {}), 0.5, 0.1);
  EXPECT_THROW((void)colour_histogram_cue(Image(10, 10, CV_8UC1)), ArgumentError);
}

TEST(GradientLayout, TellsOrientationsApartWhateverTheContrast) {
  Image upright(72, 96, CV_8UC1), strong, flat;
  for (int x = 0; x < 96; ++x) upright.col(x).setTo(x / 6 % 2 ? 110 : 90);
  upright.convertTo(strong, -1, 4, -300);
  cv::rotate(upright, flat, cv::ROTATE_90_CLOCKWISE);
  cv::resize(flat, flat, upright.size());
  const CueGrid grid = gradient_layout_cue(upright);
  EXPECT_EQ(grid.columns, 12);
  EXPECT_EQ(grid.rows, 9);
  EXPECT_GT(best_alignment(gradient_layout_cue(strong), grid, {}), 0.99);
  EXPECT_LT(best_alignment(gradient_layout_cue(flat), grid, {}), 0.2);
  EXPECT_THROW((void)gradient_layout_cue(Image(10, 10, CV_8UC3)), ArgumentError);
}

TEST(CornerAgreement, CountsTheCornersOfOneSimilarity) {
  const CornerAgreementOptions options;
  const Image image = random_image(320, 240, 1, 4);
  const std::vector<Feature> corners = corners_of_view(image, options);
  ASSERT_GT(corners.size(), 100u);
  const cv::Mat motion = cv::getRotationMatrix2D({160, 120}, 8, 1.1);
  Image rotated;
  cv::warpAffine(image, rotated, motion, image.size());
  const int same = corner_agreement(corners_of_view(rotated, options), corners, options);
  const int other =
      corner_agreement(corners_of_view(random_image(320, 240, 1, 5), options), corners, options);
  EXPECT_GT(same, 40);
  EXPECT_LT(other, 15);
}

TEST(CornerAgreement, IsNoneWithoutCorners) {
  const CornerAgreementOptions options;
  const std::vector<Feature> none =
      corners_of_view(Image(48, 64, CV_8UC1, cv::Scalar(90)), options);
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(corner_agreement(none, none, options), 0);
}

TEST(GaborCue, AnswersAtTheOrientationAndScaleOfAGrating) {
  cv::Mat grating(120, 160, CV_8UC1);
  // Stripes across x of 8 px, 4 px at 80 columns: the finest scale.
  for (int y = 0; y < grating.rows; ++y)
    for (int x = 0; x < grating.cols; ++x)
      grating.at<uchar>(y, x) = static_cast<uchar>(128 + 80 * std::cos(2 * 3.14159265 * x / 8));
  const GaborOptions options;
  const CueGrid grid = gabor_cue(grating);
  EXPECT_EQ(grid.channels, 2 * options.scales * options.orientations);
  for (int cell = 0; cell < 16; ++cell) {
    const auto first = grid.values.begin() + cell * grid.channels;
    EXPECT_EQ(std::max_element(first, first + options.orientations) - first, 0) << cell;
  }
}

TEST(GaborCue, IsTheSameInOtherLightAndOtherForAnotherTexture) {
  const Image image = random_image(160, 120, 1, 31);
  Image darker;
  image.convertTo(darker, -1, 0.5, 20);
  const double same = best_alignment(gabor_cue(image), gabor_cue(darker), {});
  EXPECT_GT(same, 0.98);
  EXPECT_LT(best_alignment(gabor_cue(image), gabor_cue(random_image(160, 120, 1, 32)), {}),
            same - 0.3);
  EXPECT_THROW((void)gabor_cue(Image(10, 10, CV_8UC3)), ArgumentError);
  const CueGrid blank = gabor_cue(Image(60, 80, CV_8UC1, cv::Scalar(77)));
  EXPECT_EQ(best_alignment(blank, gabor_cue(image), {}), 0);
}

}  // namespace place_cues_test
}  // namespace placegraph
