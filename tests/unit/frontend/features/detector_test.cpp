#include <gtest/gtest.h>
#include <placegraph/frontend/features/detector.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/texture.h"

namespace placegraph {
namespace detector_test {

using namespace test;
constexpr int kWidth = 240, kHeight = 180;
const Texture kTexture{3, 16, 2, 60};

TEST(Detector, FindsTheSameFeaturesEveryTime) {
  const Image image = texture_image(kWidth, kHeight, kTexture);
  const auto a = detect_features(image, {}), b = detect_features(image, {});
  ASSERT_GT(a.size(), 100u);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].px, b[i].px);
    EXPECT_EQ(a[i].descriptor, b[i].descriptor);
    EXPECT_FALSE(a[i].point_cam);
    EXPECT_GE(a[i].octave, 0);
    EXPECT_LT(a[i].octave, DetectorOptions{}.octaves);
  }
}

TEST(Detector, SpreadsAFewFeaturesOverTheImage) {
  // The left half has more contrast.
  Image image = texture_image(kWidth, kHeight, kTexture);
  for (int v = 0; v < kHeight; ++v)
    for (int u = kWidth / 2; u < kWidth; ++u)
      image.at<std::uint8_t>(v, u) =
          static_cast<std::uint8_t>(32 + 3 * image.at<std::uint8_t>(v, u) / 4);
  DetectorOptions options;
  options.max_features = 200;
  options.fast_threshold = 5;
  const auto features = detect_features(image, options);
  EXPECT_LE(features.size(), 200u);
  EXPECT_GE(features.size(), 190u);
  int right = 0;
  for (const Feature& f : features) right += f.px.x() > kWidth / 2;
  EXPECT_GE(right, 35);
}

TEST(Detector, LooksOnlyWhereTheMaskAllowsAndFindsNothingOnFlatGround) {
  Image mask = Image::zeros(kHeight, kWidth, CV_8UC1);
  mask.colRange(120, kWidth).setTo(255);
  const auto features = detect_features(texture_image(kWidth, kHeight, kTexture), {}, mask);
  ASSERT_FALSE(features.empty());
  for (const Feature& f : features) EXPECT_GT(f.px.x(), 116);  // a pixel of the coarsest octave
  EXPECT_TRUE(detect_features(Image(kHeight, kWidth, CV_8UC1, cv::Scalar(50)), {}).empty());
}

TEST(Detector, RefusesColourImages) {
  EXPECT_THROW(detect_features(Image(kHeight, kWidth, CV_8UC3), {}), ArgumentError);
}

}  // namespace detector_test
}  // namespace placegraph
