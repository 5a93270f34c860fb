#include <gtest/gtest.h>
#include <placegraph/frontend/flow/anchored_patch.h>
#include <placegraph/graph/core/random.h>

#include <Eigen/LU>
#include <opencv2/video/tracking.hpp>

#include "tests/support/scenes/texture.h"

namespace placegraph {
namespace anchored_patch_test {

using test::Texture;
constexpr int kWidth = 120, kHeight = 100;
const Texture kTexture{3, 16, 2, 50};
const Eigen::Vector2f kMiddle(60, 50);

/// The texture as it looks when point kMiddle + offset is at `place`, with noise and another light.
Image warped(const AnchoredPatch::Place& place, double gain = 1, double bias = 0,
             double noise = 0) {
  Random random(5);
  const Eigen::Matrix2f back = place.A.inverse();
  Image image(kHeight, kWidth, CV_8UC1);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) {
      const Eigen::Vector2f at =
          kMiddle +
          back * (Eigen::Vector2f(static_cast<float>(u), static_cast<float>(v)) - place.px);
      image.at<std::uint8_t>(v, u) =
          test::to_grey(gain * kTexture.grey(at.x(), at.y()) + bias + noise * random.normal());
    }
  return image;
}

std::vector<Image> pyramid_of(const Image& image) {
  std::vector<Image> pyramid;
  cv::buildOpticalFlowPyramid(image, pyramid, cv::Size(21, 21), 3);
  return pyramid;
}

AnchoredPatch patch() {
  return *AnchoredPatch::take(warped({kMiddle, Eigen::Matrix2f::Identity()}), kMiddle);
}

AnchoredPatch::Place place(float u, float v, float a, float b, float c, float d) {
  AnchoredPatch::Place place;
  place.px = {u, v};
  place.A << a, b, c, d;
  return place;
}

TEST(AnchoredPatch, IsFoundWhereItLiesHoweverItIsWarpedAndLit) {
  for (const AnchoredPatch::Place& truth :
       {place(61.3f, 49.2f, 1, 0, 0, 1), place(60.4f, 50.7f, 1.15f, 0.05f, -0.04f, 1.1f),
        place(59.2f, 50.3f, 0.9f, -0.1f, 0.1f, 0.92f)}) {
    const auto found = patch().find(pyramid_of(warped(truth, 0.8, 25)),
                                    {kMiddle, Eigen::Matrix2f::Identity()}, 3, 0.8f);
    ASSERT_TRUE(found) << truth.px.transpose();
    EXPECT_LT((found->px - truth.px).norm(), 0.03f) << truth.px.transpose();
    EXPECT_LT((found->A - truth.A).norm(), 0.04f) << found->A;
  }
}

TEST(AnchoredPatch, IsFoundTwiceAsLargeOnACoarserLevel) {
  const AnchoredPatch::Place truth = place(57.6f, 52.2f, 2.1f, 0, 0.1f, 2);
  AnchoredPatch::Place start = truth;
  start.px += Eigen::Vector2f(0.9f, -0.7f);
  start.A *= 0.95f;
  const auto found = patch().find(pyramid_of(warped(truth)), start, 3, 0.8f);
  ASSERT_TRUE(found);
  EXPECT_LT((found->px - truth.px).norm(), 0.1f);
}

TEST(AnchoredPatch, SaysHowFarItMayBeOff) {
  const AnchoredPatch anchor = patch();
  double sum = 0;
  int n = 0;
  for (int i = 0; i < 40; ++i) {
    const AnchoredPatch::Place truth =
        place(60.5f + 0.02f * static_cast<float>(i), 49.7f, 1.02f, 0, 0, 1);
    Image image = warped(truth);
    Random random(100 + i);
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) {
        auto& grey = image.at<std::uint8_t>(v, u);
        grey = test::to_grey(grey + 6 * random.normal());
      }
    const auto found =
        anchor.find(pyramid_of(image), {kMiddle, Eigen::Matrix2f::Identity()}, 3, 0.8f);
    ASSERT_TRUE(found);
    const Eigen::Vector2f e = found->px - truth.px;
    sum += e.dot(found->covariance.inverse() * e) / 2;
    ++n;
  }
  // Pixels are reckoned to err alike in pairs; this noise is of each alone.
  EXPECT_GT(sum / n, 0.1);
  EXPECT_LT(sum / n, 1.5);
}

TEST(AnchoredPatch, IsNotTakenWhereNothingIsToBeSeenOrTheImageEnds) {
  const Image flat(kHeight, kWidth, CV_8UC1, cv::Scalar(90));
  EXPECT_FALSE(AnchoredPatch::take(flat, kMiddle));
  Image edge = flat.clone();
  edge.colRange(0, 60).setTo(30);  // says nothing along itself
  EXPECT_FALSE(AnchoredPatch::take(edge, kMiddle));
  const Image full = warped({kMiddle, Eigen::Matrix2f::Identity()});
  EXPECT_TRUE(AnchoredPatch::take(full, {12, 12}));
  EXPECT_FALSE(AnchoredPatch::take(full, {5, 12}));
  EXPECT_FALSE(AnchoredPatch::take(full, {12, kHeight - 5}));
}

TEST(AnchoredPatch, IsNotFoundElsewhereOrWhereSomethingElseIs) {
  const AnchoredPatch anchor = patch();
  const AnchoredPatch::Place here{kMiddle, Eigen::Matrix2f::Identity()};
  const auto moved = pyramid_of(warped(place(63, 50, 1, 0, 0, 1)));
  EXPECT_TRUE(anchor.find(moved, here, 4, 0.8f));
  EXPECT_FALSE(anchor.find(moved, here, 2, 0.8f));
  EXPECT_FALSE(anchor.find(pyramid_of(test::texture_image(kWidth, kHeight, {77, 16, 2, 50})), here,
                           3, 0.8f));
  EXPECT_FALSE(anchor.find(moved, {{2, 2}, Eigen::Matrix2f::Identity()}, 4, 0.8f));
}

TEST(AnchoredPatch, IsNotComparedAfterStrongWarps) {
  Eigen::Matrix2f A = Eigen::Matrix2f::Identity();
  EXPECT_TRUE(AnchoredPatch::is_comparable(A));
  A << 0, -1, 1, 0;
  EXPECT_TRUE(AnchoredPatch::is_comparable(A));
  A << 2, 0, 0, 0.7f;
  EXPECT_FALSE(AnchoredPatch::is_comparable(A));  // foreshortened
  A << 3, 0, 0, 3;
  EXPECT_FALSE(AnchoredPatch::is_comparable(A));
  A << -1, 0, 0, 1;
  EXPECT_FALSE(AnchoredPatch::is_comparable(A));  // mirrored
}

}  // namespace anchored_patch_test
}  // namespace placegraph
