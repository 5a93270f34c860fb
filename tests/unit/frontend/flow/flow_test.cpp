#include <gtest/gtest.h>
#include <placegraph/frontend/flow/flow_vector.h>
#include <placegraph/frontend/flow/horn_schunck.h>
#include <placegraph/frontend/flow/interpolation_flow.h>
#include <placegraph/frontend/flow/optical_flow.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "tests/support/scenes/texture.h"

namespace placegraph {
namespace flow_test {

using Eigen::Vector2d;
using test::Texture;
using Kind = FlowVector::Kind;

constexpr int kSide = 96;
const Texture kFine{.seed = 3, .wavelength = 24, .octaves = 3, .contrast = 45};

/// What is at (u, v) of the first is at (u, v) + flow of the second.
struct Pair {
  Image from, to;
};

Pair shifted(const Vector2d& flow, const Texture& texture = kFine) {
  return {test::texture_image(kSide, kSide, texture),
          test::texture_image(kSide, kSide, texture, -flow.x(), -flow.y())};
}

/// The second is the first turned about the centre, u towards v.
Pair rotated(double angle) {
  Pair pair{test::texture_image(kSide, kSide, kFine), Image(kSide, kSide, CV_8UC1)};
  const double c = std::cos(angle), s = std::sin(angle), middle = kSide / 2;
  for (int v = 0; v < kSide; ++v)
    for (int u = 0; u < kSide; ++u) {
      const double x = u - middle, y = v - middle;
      pair.to.at<std::uint8_t>(v, u) =
          test::to_grey(kFine.grey(middle + c * x + s * y, middle - s * x + c * y));
    }
  return pair;
}

Pair stripes(double shift) {  // vertical ones: only u can be seen
  Pair pair{Image(kSide, kSide, CV_8UC1), Image(kSide, kSide, CV_8UC1)};
  for (int v = 0; v < kSide; ++v)
    for (int u = 0; u < kSide; ++u) {
      pair.from.at<std::uint8_t>(v, u) = test::to_grey(128 + 80 * std::sin(0.3 * u));
      pair.to.at<std::uint8_t>(v, u) = test::to_grey(128 + 80 * std::sin(0.3 * (u - shift)));
    }
  return pair;
}

const Vector2d kMiddle(kSide / 2, kSide / 2);

TEST(LucasKanade, FindsShiftsToHundredthsOfAPixel) {
  for (const Vector2d& flow : {Vector2d(0.3, -0.4), Vector2d(2.5, 1.25), Vector2d(-7.2, 5.6)}) {
    const Pair pair = shifted(flow);
    const auto found = lucas_kanade(pair.from, pair.to, {kMiddle}, {});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].kind, Kind::kFull);
    EXPECT_LT((found[0].flow - flow).norm(), 0.03) << found[0].flow.transpose();
    EXPECT_GT(found[0].covariance(0, 0), 0);
    EXPECT_LT(found[0].covariance(0, 0), 0.05 * 0.05);
  }
}

TEST(LucasKanade, GivesNormalFlowWhereOneDirectionIsSeenAndNothingWhereNone) {
  const Pair pair = stripes(1.5);
  const auto found = lucas_kanade(pair.from, pair.to, {kMiddle}, {});
  EXPECT_EQ(found[0].kind, Kind::kNormal);
  EXPECT_NEAR(found[0].flow.x(), 1.5, 0.03);
  EXPECT_NEAR(found[0].flow.y(), 0, 1e-6);
  EXPECT_LT(found[0].covariance(1, 1), 1e-9);
  const Image blank(kSide, kSide, CV_8UC1, cv::Scalar(90));
  EXPECT_EQ(lucas_kanade(blank, blank, {kMiddle}, {})[0].kind, Kind::kNone);
}

TEST(LucasKanade, FollowsPointsAtTheSidesByWhatIsInTheImageAlone) {
  // The mirrored rest of their windows seems to move the other way.
  for (const Vector2d& flow : {Vector2d(3, 0), Vector2d(-3, 0), Vector2d(0, 3), Vector2d(0, -3)}) {
    const Pair pair = shifted(flow);
    const double side = kSide / 2 * (1 - flow.normalized().sum());
    const double near = std::clamp(side, 2.0, kSide - 3.0);
    std::vector<Vector2d> points;
    for (int along = 20; along <= kSide - 20; along += 8)
      points.push_back(flow.x() != 0 ? Vector2d(near, along) : Vector2d(along, near));
    double worst_px = 0;
    for (const FlowVector& v : lucas_kanade(pair.from, pair.to, points, {})) {
      ASSERT_EQ(v.kind, Kind::kFull);
      worst_px = std::max(worst_px, (v.flow - flow).norm());
    }
    EXPECT_LT(worst_px, 0.1) << flow.transpose();
  }
}

TEST(LucasKanade, SaysNothingOfPointsThatLeaveTheImageOrDoNotComeBack) {
  const Pair pair = shifted({-6, 0});
  EXPECT_EQ(lucas_kanade(pair.from, pair.to, {Vector2d(2, 40)}, {})[0].kind, Kind::kNone);
  const Texture other{.seed = 99, .wavelength = 24, .octaves = 3, .contrast = 45};
  const Image unlike = test::texture_image(kSide, kSide, other);
  int full = 0;
  const auto grid = flow_grid(kSide, kSide, 16);
  for (const FlowVector& v : lucas_kanade(pair.from, unlike, grid, {}))
    full += v.kind == Kind::kFull;
  EXPECT_LE(full, static_cast<int>(grid.size()) / 4);
}

TEST(InterpolationFlow, FindsShiftsUpToFourPixelsToATwentiethOfAPixel) {
  const InterpolationFlow method({});
  for (const Vector2d& flow : {Vector2d(0.2, -0.7), Vector2d(1.6, 1.1), Vector2d(-2.9, 2.7)}) {
    const Pair pair = shifted(flow);
    const auto motion = method.measure(method.pyramid(pair.from), method.pyramid(pair.to), kMiddle);
    ASSERT_TRUE(motion);
    EXPECT_LT((motion->shift - flow).norm(), 0.05) << motion->shift.transpose();
    EXPECT_NEAR(motion->rotation, 0, 0.005);
    EXPECT_NEAR(motion->gain, 1, 0.02);
  }
}

TEST(InterpolationFlow, FindsTheRotationOfAPatchAndItsShiftAtOnce) {
  const InterpolationFlow method({});
  for (const double angle : {-0.12, 0.04, 0.15}) {
    const Pair pair = rotated(angle);
    const auto motion = method.measure(method.pyramid(pair.from), method.pyramid(pair.to), kMiddle);
    ASSERT_TRUE(motion);
    EXPECT_NEAR(motion->rotation, angle, 0.005);
    EXPECT_LT(motion->shift.norm(), 0.05);
    EXPECT_LT(std::sqrt(motion->covariance(2, 2)), 0.01);
  }
}

TEST(InterpolationFlow, LeavesGainAndOffsetOfTheGreyValuesFree) {
  Pair pair = shifted({1.2, -0.8});
  Image dim;
  pair.to.convertTo(dim, CV_8U, 0.7, 30);
  const InterpolationFlow method({});
  const auto motion = method.measure(method.pyramid(pair.from), method.pyramid(dim), kMiddle);
  ASSERT_TRUE(motion);
  EXPECT_LT((motion->shift - Vector2d(1.2, -0.8)).norm(), 0.05);
  EXPECT_NEAR(motion->gain, 0.7, 0.03);
}

TEST(InterpolationFlow, SaysNothingOfStripesAndOfWhatIsUnlike) {
  const InterpolationFlow method({});
  const Pair pair = stripes(1);
  EXPECT_FALSE(method.measure(method.pyramid(pair.from), method.pyramid(pair.to), kMiddle));
  const Texture other{.seed = 99, .wavelength = 24, .octaves = 3, .contrast = 45};
  const Image a = shifted({0, 0}).from, b = test::texture_image(kSide, kSide, other);
  EXPECT_FALSE(method.measure(method.pyramid(a), method.pyramid(b), kMiddle));
  EXPECT_FALSE(method.measure(method.pyramid(a), method.pyramid(a), Vector2d(-5, 20)));
}

TEST(HornSchunck, FollowsASmoothFieldOverTheWholeImage) {
  const Vector2d flow(3.3, -2.1);
  const Texture smooth{.seed = 5, .wavelength = 20, .octaves = 2, .contrast = 60};
  const Pair pair = shifted(flow, smooth);
  const Image found = horn_schunck(pair.from, pair.to, {});
  double sum = 0;
  int count = 0;
  for (int v = 8; v < kSide - 8; ++v)
    for (int u = 8; u < kSide - 8; ++u, ++count) {
      const auto& d = found.at<cv::Vec2f>(v, u);
      sum += std::hypot(d[0] - flow.x(), d[1] - flow.y());
    }
  EXPECT_LT(sum / count, 0.05);
  EXPECT_TRUE(std::isnan(found.at<cv::Vec2f>(0, kSide - 1)[0])) << "leads out of the image";
}

TEST(KeyPixelFlow, MatchesBlobsAcrossLargeMotion) {
  const Vector2d flow(21, -13);
  const Pair pair = shifted(flow, {.seed = 8, .wavelength = 14, .octaves = 2, .contrast = 60});
  const auto found = key_pixel_flow(pair.from, pair.to, {});
  ASSERT_GE(found.size(), 8u);
  std::size_t right = 0;
  for (const FlowVector& vector : found) right += (vector.flow - flow).norm() < 1;
  EXPECT_GE(right, found.size() * 9 / 10);
}

TEST(OpticalFlow, EveryMethodAnswersInOneForm) {
  const Vector2d flow(1.4, 0.6);
  const Pair pair = shifted(flow);
  FlowOptions options;
  for (std::size_t i = 0; i < flow_method_names().size(); ++i) {
    options.method = static_cast<FlowMethod>(i);
    const Image found = optical_flow(pair.from, pair.to, options);
    ASSERT_EQ(found.type(), CV_32FC2) << flow_method_names()[i];
    ASSERT_EQ(found.size(), pair.from.size());
    int known = 0, right = 0;
    for (int v = 0; v < kSide; ++v)
      for (int u = 0; u < kSide; ++u) {
        const auto& d = found.at<cv::Vec2f>(v, u);
        if (std::isnan(d[0])) continue;
        ++known;
        right += std::hypot(d[0] - flow.x(), d[1] - flow.y()) < 0.5;
      }
    EXPECT_GT(known, 10) << flow_method_names()[i];
    EXPECT_GT(right, known * 8 / 10) << flow_method_names()[i];
  }
}

TEST(OpticalFlow, RefusesImagesThatDoNotFit) {
  const Image grey(40, 40, CV_8UC1, cv::Scalar(0)), other(40, 41, CV_8UC1, cv::Scalar(0));
  EXPECT_THROW((void)optical_flow(grey, other, {}), ArgumentError);
  EXPECT_THROW((void)optical_flow({}, {}, {}), ArgumentError);
  FlowOptions options;
  options.lucas_kanade.window_px = 8;
  EXPECT_THROW((void)optical_flow(grey, grey, options), ArgumentError);
}

/// Grey values of `shape(u, v)` with noise.
template <class Shape>
Image picture(const Shape& shape, double sigma) {
  Random random(3);
  Image image(360, 480, CV_8UC1);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u)
      image.at<unsigned char>(v, u) = static_cast<unsigned char>(
          std::clamp(shape(u, v) + random.normal(0, sigma) + 0.5, 0.0, 255.0));
  return image;
}

TEST(FlowVector, TellsTheNoiseOfPixelsBesideSlopesAndEdges) {
  for (const double sigma : {2.0, 5.0}) {
    const Image image =
        picture([](int u, int v) { return 40 + 0.2 * u + 0.1 * v + (u > 80 ? 50 : 0); }, sigma);
    EXPECT_NEAR(image_noise(image), sigma, 0.2 * sigma);
  }
  EXPECT_EQ(image_noise(picture([](int, int) { return 100; }, 0)), 0.5);
  EXPECT_EQ(image_noise(Image(1, 1, CV_8UC1, cv::Scalar(0))), 0.5);
}

TEST(FlowVector, IsSureAcrossAnEdgeAndNotAlongIt) {
  const Image image = picture([](int u, int) { return u > 80 ? 160 : 80; }, 2);
  const Eigen::Matrix2d covariance = track_covariance(image, {80, 60}, 15, 2);
  EXPECT_LT(std::sqrt(covariance(0, 0)), 0.05);
  EXPECT_GT(std::sqrt(covariance(1, 1)), 0.2);  // the noise looks like something
}

TEST(FlowVector, FollowsTheGradientsOfASlope) {
  // Slope 0.3 in u and 0.2 in v all over: only the direction (3, 2) is seen.
  const Image image = picture([](int u, int v) { return (3 * u + 2 * v) / 10.0; }, 0);
  const Eigen::Matrix2d covariance = track_covariance(image, {80, 60}, 15, 0.1);
  const Eigen::Vector2d across = Eigen::Vector2d(3, 2).normalized();
  const double information = 225 * (9 + 4) / 100.0 / (0.1 * 0.1);
  EXPECT_NEAR(across.dot(covariance * across), 2 / information, 0.2 * 2 / information);
  const Eigen::Vector2d along(-across.y(), across.x());
  EXPECT_GT(along.dot(covariance * along), 10 * across.dot(covariance * across));
  EXPECT_TRUE(track_covariance(image, {0, 0}, 15, 1).allFinite());
}

TEST(FlowVector, AreSampledWhereThereIsTextureAndNotWhereThereIsNoise) {
  // Waves on the left, noise alone on the right; nothing is known in the lowest row of cells.
  const Image image = picture(
      [](int u, int v) { return 120 + (u < 240 ? 40 * std::sin(0.4 * u) * std::sin(0.5 * v) : 0); },
      3);
  Image flow(image.size(), CV_32FC2, cv::Scalar(1.5, -0.5));
  flow.rowRange(344, 360).setTo(cv::Scalar::all(NAN));
  const auto vectors = sampled_flow(image, flow, 16);
  int right = 0;
  for (const FlowVector& vector : vectors) {
    EXPECT_EQ(vector.flow, Eigen::Vector2d(1.5, -0.5));
    EXPECT_LT(vector.covariance.trace(), 0.2 * 0.2);
    EXPECT_LT(vector.px.y(), 344);
    right += vector.px.x() > 250;
  }
  EXPECT_EQ(right, 0);
  EXPECT_GT(vectors.size(), 300u);  // of 15 x 22 cells
  EXPECT_THROW((void)sampled_flow(image, Image(), 16), ArgumentError);
}

}  // namespace flow_test
}  // namespace placegraph
