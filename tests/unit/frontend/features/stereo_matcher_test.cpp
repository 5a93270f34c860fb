#include <gtest/gtest.h>
#include <placegraph/frontend/features/stereo_matcher.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/scene.h"
#include "tests/support/scenes/texture.h"

namespace placegraph {
namespace stereo_matcher_test {

using namespace test;
const Camera kCamera = pinhole(320, 120, 250);
constexpr double kBaseline_m = 0.5;

struct Pair {
  Picture left, right;
};

Pair see(const std::vector<TexturedPlane>& planes) {
  return {render(kCamera, SE3(), planes),
          render(kCamera, pose({0, 0, 0}, {kBaseline_m, 0, 0}), planes)};
}

TexturedPlane wall(double depth_m, double tilt_rad = 0, double lattice_px = 15) {
  return {pose({0, tilt_rad, 0}, {0, 0, depth_m}),
          1e3,
          1e3,
          {9, lattice_px / kCamera.fx * depth_m, 2, 60}};
}

std::vector<Eigen::Vector2f> grid(float first_u) {
  std::vector<Eigen::Vector2f> px;
  for (float v = 12; v < 110; v += 9.37f)
    for (float u = first_u; u < 305; u += 11.71f) px.emplace_back(u, v);
  return px;
}

TEST(StereoMatcher, MeasuresDisparitiesToATenthOfAPixel) {
  for (const double depth_m : {35.0, 6.1, 2.05}) {  // 3.6, 20.5, 61 px
    const Pair pair = see({wall(depth_m)});
    const double truth = kCamera.fx * kBaseline_m / depth_m;
    const auto px = grid(static_cast<float>(truth) + 12);
    const auto disparities = match_stereo(pair.left.grey, pair.right.grey, px, {});
    ASSERT_EQ(disparities.size(), px.size());
    std::size_t found = 0;
    double sum2 = 0;
    for (const auto& d : disparities) {
      if (!d) continue;
      ++found;
      sum2 += (*d - truth) * (*d - truth);
      EXPECT_NEAR(*d, truth, StereoMatcherOptions{}.sigma_disparity_px);
    }
    EXPECT_GT(found, 0.95 * px.size()) << depth_m;
    EXPECT_LT(std::sqrt(sum2 / found), 0.1) << depth_m;
  }
}

TEST(StereoMatcher, FollowsASlantedWall) {
  const Pair pair = see({wall(8, 0.4)});
  const auto px = grid(40);
  const auto disparities = match_stereo(pair.left.grey, pair.right.grey, px, {});
  std::size_t found = 0;
  double sum2 = 0;
  for (std::size_t i = 0; i < px.size(); ++i) {
    if (!disparities[i]) continue;
    ++found;
    const int u = static_cast<int>(std::lround(px[i].x())),
              v = static_cast<int>(std::lround(px[i].y()));
    const double error =
        *disparities[i] - kCamera.fx * kBaseline_m / pair.left.depth.at<float>(v, u);
    EXPECT_LT(std::abs(error), 2 * StereoMatcherOptions{}.sigma_disparity_px);
    sum2 += error * error;
  }
  // The slope stretches the patch by 3 %, on top of the tenth.
  EXPECT_LT(std::sqrt(sum2 / found), 0.15);
  EXPECT_GT(found, 0.9 * px.size());
}

TEST(StereoMatcher, SaysNothingWithoutTexture) {
  const Image flat(120, 320, CV_8UC1, cv::Scalar(77));
  for (const auto& d : match_stereo(flat, flat, grid(40), {})) EXPECT_FALSE(d);
}

TEST(StereoMatcher, AnExpectationChangesWhereItLooksFirstNotWhatItFinds) {
  const Pair pair = see({wall(6.1)});
  const double truth = kCamera.fx * kBaseline_m / 6.1;
  const auto px = grid(35);
  const auto alone = match_stereo(pair.left.grey, pair.right.grey, px, {});
  for (const double expected : {truth + 3, truth + 40}) {  // right, and far off
    const std::vector<std::optional<double>> all(px.size(), expected);
    const auto found = match_stereo(pair.left.grey, pair.right.grey, px, {}, all);
    std::size_t same = 0;
    for (std::size_t i = 0; i < px.size(); ++i)
      same += alone[i].has_value() == found[i].has_value() &&
              (!alone[i] || std::abs(*alone[i] - *found[i]) < 1e-3);
    EXPECT_GE(same, px.size() * 95 / 100) << expected;
  }
  EXPECT_THROW(match_stereo(pair.left.grey, pair.right.grey, px, {}, {1.0}), ArgumentError);
}

TEST(StereoMatcher, SaysNothingBeyondTheGreatestDisparity) {
  const Pair pair = see({wall(2.05, 0, 6)});  // 61 px
  StereoMatcherOptions options;
  options.max_disparity_px = 50;
  std::size_t found = 0;
  const auto disparities = match_stereo(pair.left.grey, pair.right.grey, grid(75), options);
  for (const auto& d : disparities) found += d.has_value();
  EXPECT_LT(found, 0.03 * disparities.size());  // what looks alike by chance
}

TEST(StereoMatcher, SaysNothingWhereOnlyOneCameraSees) {
  // A near board hides, from the right eye, the strip of the wall on its left side.
  TexturedPlane board = wall(3);
  board.half_x_m = 0.4;
  board.half_y_m = 5;
  board.texture.seed = 77;
  const Pair pair = see({wall(12), board});
  const double near_px = kCamera.fx * kBaseline_m / 3, far_px = kCamera.fx * kBaseline_m / 12;
  const double edge = kCamera.cx - kCamera.fx * 0.4 / 3;  // of the board, in the left image
  std::vector<Eigen::Vector2f> hidden;
  for (float v = 12; v < 110; v += 6)
    for (double u = edge - (near_px - far_px) + 9; u < edge - 9; u += 2)
      hidden.emplace_back(static_cast<float>(u), v);
  ASSERT_GT(hidden.size(), 50u);
  std::size_t found = 0;
  for (const auto& d : match_stereo(pair.left.grey, pair.right.grey, hidden, {}))
    found += d.has_value();
  EXPECT_LT(found, 0.05 * hidden.size());
}

TEST(StereoMatcher, SaysNothingAtTheBorderAndRefusesOtherSizes) {
  const Pair pair = see({wall(6)});
  for (const auto& d :
       match_stereo(pair.left.grey, pair.right.grey, {{2, 60}, {200, 1}, {318, 119}}, {}))
    EXPECT_FALSE(d);
  EXPECT_THROW(match_stereo(pair.left.grey, pair.right.grey.colRange(0, 100), {}, {}),
               ArgumentError);
}

}  // namespace stereo_matcher_test
}  // namespace placegraph
