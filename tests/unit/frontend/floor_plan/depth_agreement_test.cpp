#include <gtest/gtest.h>
#include <placegraph/frontend/floor_plan/depth_agreement.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace placegraph {
namespace depth_agreement_test {

constexpr int kWidth = 40, kHeight = 30;
constexpr double kFocal_px = 50, kSigma_px = 0.3;

SE3 sideways(double metres) { return {SO3(), Eigen::Vector3d(-metres, 0, 0)}; }

SweepGeometry geometry_of(const std::vector<SE3>& T_view_cam) {
  return sweep_geometry({kWidth, kHeight, kFocal_px, kFocal_px, 19.5, 14.5}, T_view_cam,
                        {.min_depth_m = 0.7, .max_depth_m = 15, .step_px = 1, .max_levels = 192});
}

/// A wall two metres away that every pixel tells.
std::vector<PixelDepth> wall() {
  return std::vector<PixelDepth>(kWidth * kHeight, {0.5, 10, true});
}
PixelDepth& pixel(std::vector<PixelDepth>& found, int u, int v) {
  return found[static_cast<std::size_t>(v) * kWidth + u];
}

TEST(AgreedDepth, KeepsWhatAViewSeesAndHowWellItTellsIt) {
  // Five pixels to the left: the first five columns are not in the view.
  const SweptDepth depth = agreed_depth(wall(), geometry_of({sideways(0.2)}), kSigma_px);
  EXPECT_EQ(cv::countNonZero(depth.depth_m), (kWidth - 5) * kHeight);
  EXPECT_EQ(depth.depth_m.at<float>(10, 4), 0);
  EXPECT_FLOAT_EQ(depth.depth_m.at<float>(10, 5), 2);
  EXPECT_FLOAT_EQ(depth.sigma_inverse.at<float>(10, 5), kSigma_px / (kFocal_px * 0.2));
}

TEST(AgreedDepth, IsBetterKnownFromTwoViews) {
  const SweptDepth depth =
      agreed_depth(wall(), geometry_of({sideways(0.2), sideways(-0.2)}), kSigma_px);
  // Either view is half of them: all columns are seen by one, those in the middle by both.
  EXPECT_EQ(cv::countNonZero(depth.depth_m), kWidth * kHeight);
  EXPECT_FLOAT_EQ(depth.sigma_inverse.at<float>(10, 20),
                  kSigma_px / (kFocal_px * 0.2 * std::sqrt(2)));
  EXPECT_FLOAT_EQ(depth.sigma_inverse.at<float>(10, 2), kSigma_px / (kFocal_px * 0.2));
}

TEST(AgreedDepth, NeedsTheBetterHalfOfTheViews) {
  const SweptDepth depth =
      agreed_depth(wall(), geometry_of({sideways(0.2), sideways(0.2), sideways(-0.2)}), kSigma_px);
  EXPECT_EQ(depth.depth_m.at<float>(10, 2), 0);   // seen by the third alone
  EXPECT_GT(depth.depth_m.at<float>(10, 38), 0);  // by the first two
}

TEST(AgreedDepth, DropsAPointWhosePlaceInAViewABetterOneTakes) {
  for (const double cost : {5.0, 20.0}) {
    std::vector<PixelDepth> found = wall();
    pixel(found, 25, 10) = {0.8, cost, true};  // moves by eight pixels, to column 17
    const SweptDepth depth = agreed_depth(found, geometry_of({sideways(0.2)}), kSigma_px);
    const bool better = cost < 10;
    EXPECT_EQ(depth.depth_m.at<float>(10, 25) > 0, better);
    EXPECT_EQ(depth.depth_m.at<float>(10, 22) > 0, !better);  // of the wall, moves there too
  }
}

TEST(AgreedDepth, DropsDepthsKnownToLessThanAFifth) {
  // 0.3 px over 50 px m * 0.02 m is 0.3 / m, of 0.5 / m.
  EXPECT_EQ(
      cv::countNonZero(agreed_depth(wall(), geometry_of({sideways(0.02)}), kSigma_px).depth_m), 0);
  // 0.06 / m is less than a fifth of it.
  EXPECT_GT(cv::countNonZero(agreed_depth(wall(), geometry_of({sideways(0.02)}), 0.06).depth_m), 0);
}

TEST(AgreedDepth, IsCertainWhereAllPixelsAboutTellTheSame) {
  const SweepGeometry geometry = geometry_of({sideways(0.2)});
  std::vector<PixelDepth> found = wall();
  // Two columns and rows at the border have not all their neighbours; the first five are not seen.
  EXPECT_EQ(cv::countNonZero(agreed_depth(found, geometry, kSigma_px).certain),
            (kWidth - 5 - 4) * (kHeight - 4));
  pixel(found, 25, 10).distinct = false;
  const Image certain = agreed_depth(found, geometry, kSigma_px).certain;
  EXPECT_EQ(cv::countNonZero(certain), (kWidth - 5 - 4) * (kHeight - 4) - 25);
  EXPECT_EQ(certain.at<std::uint8_t>(12, 27), 0);
  EXPECT_EQ(certain.at<std::uint8_t>(12, 28), 255);
}

TEST(AgreedDepth, IsCertainOnEitherSideOfAStepInDepthButNotOnIt) {
  const SweepGeometry geometry = geometry_of({sideways(0.2)});
  // From one row to the next, so that nothing hides anything from a view beside.
  const auto certain_with_step = [&](double levels) {
    std::vector<PixelDepth> found = wall();
    for (int v = 0; v < 15; ++v)
      for (int u = 0; u < kWidth; ++u)
        pixel(found, u, v).inverse_depth = 0.5 - levels * geometry.step;
    const SweptDepth depth = agreed_depth(found, geometry, 0.1);
    EXPECT_GT(depth.depth_m.at<float>(14, 20), 0);
    EXPECT_GT(depth.depth_m.at<float>(15, 20), 0);
    return depth.certain;
  };
  const Image step = certain_with_step(3.5);
  for (const int v : {10, 12, 17, 20}) EXPECT_EQ(step.at<std::uint8_t>(v, 20), 255) << v;
  for (const int v : {13, 14, 15, 16}) EXPECT_EQ(step.at<std::uint8_t>(v, 20), 0) << v;
  EXPECT_EQ(certain_with_step(2).at<std::uint8_t>(14, 20), 255);  // a slope is no step
}

}  // namespace depth_agreement_test
}  // namespace placegraph
