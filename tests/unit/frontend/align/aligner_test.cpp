#include <gtest/gtest.h>
#include <placegraph/frontend/align/aligner.h>
#include <placegraph/frontend/align/alignment_covariance.h>
#include <placegraph/frontend/flow/grey_pyramid.h>
#include <placegraph/graph/core/error.h>

#include <numbers>

#include "tests/support/scenes/warped_template.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace aligner_test {

using namespace test;
using Code = Outcome::Code;
using Eigen::Matrix3d;
using Eigen::Vector2d;

constexpr int kWidth = 160, kHeight = 130;
const Texture kTexture{11, 24, 2, 55};
const std::vector<Vector2d> kSquare = {{45, 30}, {115, 30}, {115, 100}, {45, 100}};

PlanarTemplate make_template(const Texture& texture = kTexture, int levels = 2) {
  return {texture_image(kWidth, kHeight, texture), kSquare, levels, 2500};
}

double error_px(const PlanarTemplate& t, const AlignResult& result, const Matrix3d& truth) {
  return t.corner_distance_px(result.warp.H_cur_ref(), truth);
}

TEST(GreyPyramid, InterpolatesAParabolaExactlyWithItsSlope) {
  Image image(12, 12, CV_32FC1);
  for (int v = 0; v < 12; ++v)
    for (int u = 0; u < 12; ++u) image.at<float>(v, u) = static_cast<float>(u * u - 2 * u * v + v);
  const GreySample sample = sample_bicubic(image, 5.3, 6.8);
  EXPECT_NEAR(sample.value, 5.3 * 5.3 - 2 * 5.3 * 6.8 + 6.8, 1e-4);
  EXPECT_NEAR(sample.du, 2 * 5.3 - 2 * 6.8, 1e-4);
  EXPECT_NEAR(sample.dv, -2 * 5.3 + 1, 1e-4);
  EXPECT_EQ(value_bicubic(image, 5.3, 6.8), sample.value);
  EXPECT_FALSE(inside_bicubic(image, 10, 5));
}

TEST(PlanarTemplate, HasTheSamplesOfItsPolygonAndMask) {
  const Image image = texture_image(kWidth, kHeight, kTexture);
  const PlanarTemplate whole(image, kSquare, 2, 100000);
  EXPECT_EQ(whole.levels()[0].samples.size(), 70u * 70u);
  EXPECT_EQ(whole.levels()[1].samples.size(), 35u * 35u);
  EXPECT_EQ(whole.half_px(), 35);
  Image mask = Image::zeros(image.size(), CV_8UC1);
  mask.colRange(0, 80).setTo(255);
  EXPECT_EQ(PlanarTemplate(image, kSquare, 1, 100000, mask).levels()[0].samples.size(), 35u * 70u);
  EXPECT_LE(PlanarTemplate(image, kSquare, 1, 1000).levels()[0].samples.size(), 1000u);
  EXPECT_THROW(PlanarTemplate(image, {{0, 0}, {5, 5}}, 1, 10), ArgumentError);
  EXPECT_THROW(PlanarTemplate(image, {{0, 0}, {5, 0}, {9, 0}}, 1, 10), ArgumentError);
  EXPECT_THROW(PlanarTemplate(image, kSquare, 1, 10, Image::zeros(3, 3, CV_8UC1)), ArgumentError);
}

TEST(PlanarTemplate, HasACornerJacobianThatAgreesWithFiniteDifferences) {
  Random random = seeded_random(75);
  const PlanarTemplate t = make_template();
  const PlanarWarp warp = t.homography(random_homography(t, 6, random));
  const auto J = t.corner_jacobian(warp);
  for (int k = 0; k < 8; ++k) {
    const PlanarWarp up = warp.plus(PlanarWarp::Step::Unit(8, k) * 1e-6),
                     down = warp.plus(PlanarWarp::Step::Unit(8, k) * -1e-6);
    for (int c = 0; c < 4; ++c) {
      const Vector2d numeric = (*map_pixel(up.H_cur_ref(), t.corners_px()[c]) -
                                *map_pixel(down.H_cur_ref(), t.corners_px()[c])) /
                               2e-6;
      EXPECT_LT((J.block<2, 1>(2 * c, k) - numeric).norm(), 1e-5 * (1 + numeric.norm()));
    }
  }
}

TEST(Aligner, FindsAWarpWithEveryOptimizerThatFollowsDerivatives) {
  Random random = seeded_random(76);
  const PlanarTemplate t = make_template();
  const Matrix3d truth = random_homography(t, 4, random);
  const Image image = warped_texture(kWidth, kHeight, kTexture, truth);
  for (const auto optimizer : {AlignOptimizer::kGaussNewton, AlignOptimizer::kEsm,
                               AlignOptimizer::kInverseCompositional}) {
    AlignOptions options;
    options.optimizer = optimizer;
    const AlignResult result = align(t, image, t.homography(Matrix3d::Identity()), options);
    ASSERT_TRUE(result.outcome) << result.outcome.reason;
    EXPECT_LT(error_px(t, result, truth), 0.05) << static_cast<int>(optimizer);
    EXPECT_GT(result.agreement, 0.99);
    EXPECT_GT(result.visible_share, 0.99);
    EXPECT_EQ(result.covariance.rows(), 8);
  }
}

TEST(Aligner, FindsAWarpWithEverySimilarity) {
  Random random = seeded_random(77);
  const PlanarTemplate t = make_template();
  const Matrix3d truth = random_homography(t, 3, random);
  const Image image = warped_texture(kWidth, kHeight, kTexture, truth);
  for (const auto kind :
       {Similarity::kSsd, Similarity::kSsdGainBias, Similarity::kZncc, Similarity::kMi}) {
    AlignOptions options;
    options.gradient.similarity = kind;
    const AlignResult result = align(t, image, t.homography(Matrix3d::Identity()), options);
    ASSERT_TRUE(result.outcome) << result.outcome.reason << " " << static_cast<int>(kind);
    EXPECT_LT(error_px(t, result, truth), 0.1) << static_cast<int>(kind);
  }
}

TEST(Aligner, SaysThatATemplateLeftTheView) {
  const PlanarTemplate t = make_template();
  Matrix3d away = Matrix3d::Identity();
  away(0, 2) = 100;
  const Image image = texture_image(kWidth, kHeight, kTexture);
  EXPECT_EQ(align(t, image, t.homography(away), {}).outcome.code, Code::kTooFewData);
  Matrix3d beyond = Matrix3d::Identity();
  beyond(2, 0) = -0.01;
  EXPECT_EQ(align(t, image, t.homography(beyond), {}).outcome.code, Code::kTooFewData);
}

TEST(Aligner, SaysThatATemplateHasTooLittleTexture) {
  Texture flat = kTexture;
  flat.contrast = 0;
  const Image image = texture_image(kWidth, kHeight, kTexture);
  const PlanarTemplate t = make_template(flat);
  EXPECT_EQ(align(t, image, t.homography(Matrix3d::Identity()), {}).outcome.code,
            Code::kDegenerate);
  // Stripes hold it in one direction only.
  Image stripes(kHeight, kWidth, CV_8UC1);
  for (int u = 0; u < kWidth; ++u)
    stripes.col(u).setTo(to_grey(128 + 80 * std::sin(2 * std::numbers::pi * u / 16)));
  const PlanarTemplate striped(stripes, kSquare, 2, 2500);
  const AlignResult result = align(striped, stripes, striped.homography(Matrix3d::Identity()), {});
  EXPECT_EQ(result.outcome.code, Code::kDegenerate);
}

TEST(Aligner, SaysThatATemplateIsTooSmall) {
  const Image image = texture_image(kWidth, kHeight, kTexture);
  const PlanarTemplate t(image, {{45, 30}, {52, 30}, {52, 37}, {45, 37}}, 1, 2500);
  EXPECT_EQ(align(t, image, t.homography(Matrix3d::Identity()), {}).outcome.code,
            Code::kTooFewData);
}

TEST(Aligner, SaysThatTheImageShowsSomethingElse) {
  const PlanarTemplate t = make_template();
  Texture other = kTexture;
  other.seed = 99;
  const AlignResult result =
      align(t, texture_image(kWidth, kHeight, other), t.homography(Matrix3d::Identity()), {});
  EXPECT_FALSE(result.outcome);
}

TEST(Aligner, SaysThatItHasNotConverged) {
  Random random = seeded_random(78);
  const PlanarTemplate t = make_template(kTexture, 1);
  const Matrix3d truth = random_homography(t, 5, random);
  AlignOptions options;
  options.gradient.iterations = 1;
  options.min_agreement = options.min_inlier_share = 0;
  const AlignResult result = align(t, warped_texture(kWidth, kHeight, kTexture, truth),
                                   t.homography(Matrix3d::Identity()), options);
  EXPECT_EQ(result.outcome.code, Code::kNotConverged);
}

TEST(AlignmentCovariance, CountsBlurredNoiseAsFewerSamples) {
  Random random = seeded_random(79);
  const Image clean = texture_image(kWidth, kHeight, kTexture);
  const PlanarTemplate t(clean, kSquare, 1, 10000);
  const PlanarWarp warp = t.homography(Matrix3d::Identity());
  const Image white = disturbed(clean, 5, random);
  // The same noise, as the mean over 3x3 pixels: each of nine neighbours shares in it.
  Image smooth = clean.clone();
  Image noise(kHeight, kWidth, CV_32FC1);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      noise.at<float>(v, u) = static_cast<float>(random.normal(0, 15));
  for (int v = 1; v + 1 < kHeight; ++v)
    for (int u = 1; u + 1 < kWidth; ++u) {
      double mean = 0;
      for (int k = 0; k < 9; ++k) mean += noise.at<float>(v + k / 3 - 1, u + k % 3 - 1) / 9;
      smooth.at<std::uint8_t>(v, u) = to_grey(clean.at<std::uint8_t>(v, u) + mean);
    }
  double share[2];
  for (const int blurred : {0, 1}) {
    Image image;
    (blurred ? smooth : white).convertTo(image, CV_32F);
    const auto result = alignment_covariance(t, image, 0, warp, {.similarity = Similarity::kZncc});
    ASSERT_TRUE(result);
    EXPECT_NEAR(result->sigma_grey, 5, 0.5);
    share[blurred] = result->independent_share;
  }
  EXPECT_GT(share[0], 0.6);
  EXPECT_LT(share[1], 0.4);
  EXPECT_GT(share[1], 0.05);
}

}  // namespace aligner_test
}  // namespace placegraph
