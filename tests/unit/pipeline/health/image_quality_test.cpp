#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/pipeline/health/image_quality.h>

#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace image_quality_test {

using testing::HasSubstr;

/// Squares of side `side_px` with random grey levels from 40 to 215.
Image squares(int side_px) {
  Random random(3, 0);
  Image small(240 / side_px, 320 / side_px, CV_8UC1), image;
  for (int v = 0; v < small.rows; ++v)
    for (int u = 0; u < small.cols; ++u)
      small.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(40 + random.uniform(0, 175));
  cv::resize(small, image, {320, 240}, 0, 0, cv::INTER_NEAREST);
  return image;
}

Image blurred(const Image& image, double sigma_px) {
  Image result;
  cv::GaussianBlur(image, result, {0, 0}, sigma_px);
  return result;
}

std::optional<DataNote> note_for(const std::vector<Image>& images) {
  ImageQuality quality("images", NoteCause::kImages);
  std::int64_t id = 100;
  for (const Image& image : images) quality.add(FrameId(id++), image_statistics(image));
  return quality.note();
}

TEST(ImageStatistics, MeasureLightAndSharpness) {
  const ImageStatistics sharp = image_statistics(squares(8));
  EXPECT_NEAR(sharp.mean, 127, 8);
  EXPECT_NEAR(sharp.range, 170, 10);
  EXPECT_EQ(sharp.white, 0);
  EXPECT_NEAR(sharp.detail, 0.25, 0.03);  // every fourth pair two pixels apart lies on an edge
  EXPECT_LT(image_statistics(blurred(squares(8), 6)).detail, 0.08);
  EXPECT_NEAR(image_statistics(squares(1)).detail, 1, 0.03);
}

TEST(ImageStatistics, AreZeroForEqualLevelsAndTinyImages) {
  const ImageStatistics grey = image_statistics(Image(240, 320, CV_8UC1, cv::Scalar(90)));
  EXPECT_EQ(grey.range, 0);
  EXPECT_EQ(grey.detail, 0);
  EXPECT_EQ(image_statistics(Image(8, 8, CV_8UC1, cv::Scalar(90))).mean, 0);
}

TEST(ImageStatistics, BlurInOneDirectionIsSeen) {
  Image moved;
  cv::blur(squares(8), moved, {25, 1});
  EXPECT_LT(image_statistics(moved).detail, 0.09);
}

TEST(ImageQuality, AcceptsSharpImagesAndSlowChangesOfLight) {
  std::vector<Image> images;
  for (int i = 0; i < 30; ++i) images.push_back(squares(8) * (1 - 0.015 * i));
  EXPECT_FALSE(note_for(images));
  EXPECT_FALSE(note_for({}));
}

TEST(ImageQuality, NamesWhatMoreThanAFewImagesLack) {
  const Image good = squares(8);
  const auto with = [&](const Image& bad, int count) {
    std::vector<Image> images(20, good);
    images.insert(images.end(), static_cast<std::size_t>(count), bad);
    return note_for(images);
  };
  const Image blank = Image(240, 320, CV_8UC1, cv::Scalar(10)), noise = squares(1);
  EXPECT_FALSE(with(blank, 2));
  ASSERT_TRUE(with(blank, 3));
  EXPECT_EQ(with(blank, 3)->cause, NoteCause::kImages);
  EXPECT_THAT(with(blank, 3)->text, HasSubstr("3 of 23 images (from frame 120 on) are blank"));
  EXPECT_THAT(with(noise, 5)->text, HasSubstr("noise"));
  EXPECT_THAT(with(blurred(good, 6), 5)->text, HasSubstr("blurred"));
  EXPECT_THAT(with(good * 3, 5)->text, HasSubstr("overexposed"));
}

TEST(ImageQuality, NamesImagesThatAreCoveredForATime) {
  const Image good = squares(8);
  Image half = good.clone();
  half.colRange(0, 200).setTo(90);
  EXPECT_NEAR(image_statistics(half).uniform, 0.63, 0.03);
  std::vector<Image> images(20, good), always(20, half);
  images.insert(images.end(), 5, half);
  ASSERT_TRUE(note_for(images));
  EXPECT_THAT(note_for(images)->text, HasSubstr("5 of 25 images (from frame 120 on) are covered"));
  EXPECT_FALSE(note_for(always));  // a plain background
}

TEST(ImageQuality, NamesLightThatChangesFromImageToImage) {
  std::vector<Image> images;
  for (int i = 0; i < 20; ++i) images.push_back(squares(8) * (i % 2 == 0 ? 1.0 : 0.6));
  ASSERT_TRUE(note_for(images));
  EXPECT_THAT(note_for(images)->text, HasSubstr("brighter or darker"));
  EXPECT_THAT(note_for(images)->advice, HasSubstr("fix exposure"));
}

}  // namespace image_quality_test
}  // namespace placegraph
