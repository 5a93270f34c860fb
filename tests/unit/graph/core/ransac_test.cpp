#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/ransac.h>
#include <tests/support/seed.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace placegraph {
namespace ransac_test {

/// y = slope x + offset.
struct Line {
  double slope = 0, offset = 0;
};

struct Scene {
  std::vector<double> x, y;
  std::vector<bool> inlier;
};

constexpr double kSigma = 0.01;

Scene make_scene(Random& random, int n, double outlier_ratio) {
  Scene scene;
  for (int i = 0; i < n; ++i) {
    const bool inlier = i >= outlier_ratio * n;
    const double x = random.uniform(-1, 1);
    scene.x.push_back(x);
    scene.y.push_back(inlier ? 2 * x - 0.5 + random.normal(0, kSigma) : random.uniform(-3, 3));
    scene.inlier.push_back(inlier);
  }
  return scene;
}

RansacResult<Line> fit(const Scene& scene, const RansacOptions& options, Random& random) {
  const auto solve = [&](const std::vector<int>& s) -> std::vector<Line> {
    const double slope = (scene.y[s[1]] - scene.y[s[0]]) / (scene.x[s[1]] - scene.x[s[0]]);
    return {{slope, scene.y[s[0]] - slope * scene.x[s[0]]}};
  };
  const auto squared_error = [&](const Line& line, int i) {
    const double e = scene.y[i] - line.slope * scene.x[i] - line.offset;
    return e * e;
  };
  const auto refine = [&](const Line&, const std::vector<int>& inliers) -> Line {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const int i : inliers) {
      n += 1;
      sx += scene.x[i];
      sy += scene.y[i];
      sxx += scene.x[i] * scene.x[i];
      sxy += scene.x[i] * scene.y[i];
    }
    const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    return {slope, (sy - slope * sx) / n};
  };
  const double threshold = 3 * kSigma;
  return ransac<Line>(static_cast<int>(scene.x.size()), 2, threshold * threshold, options, random,
                      solve, squared_error, refine);
}

TEST(Ransac, FitsALineThroughSixtyPercentOutliers) {
  Random random = test::seeded_random(11);
  const Scene scene = make_scene(random, 200, 0.6);
  const auto result = fit(scene, {}, random);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  int found = 0;
  for (const int i : result.inliers) found += scene.inlier[i];
  const int wrong = static_cast<int>(result.inliers.size()) - found;
  // 80 inliers, sigma 0.01: the offset is known to 0.01 / sqrt(80) = 0.0011, the slope (x has the
  // variance 1 / 3) to 0.002; five of these. An outlier that chance puts on the line pulls by the
  // threshold / 80 at most, the slope by three times that.
  const double pull = wrong * 3 * kSigma / 80;
  EXPECT_NEAR(result.model.offset, -0.5, 5 * 0.0011 + pull);
  EXPECT_NEAR(result.model.slope, 2, 5 * 0.002 + 3 * pull);
  EXPECT_GE(found, 76);  // 99.7 % of 80 expected
  EXPECT_LE(wrong, 8);   // 120 * 0.06 / 6 = 1.2 expected
  EXPECT_TRUE(std::is_sorted(result.inliers.begin(), result.inliers.end()));
}

TEST(Ransac, SameSeedGivesTheSameModel) {
  Random scene_random = test::seeded_random(12);
  const Scene scene = make_scene(scene_random, 100, 0.5);
  Random a(3), b(3);
  const auto first = fit(scene, {}, a), second = fit(scene, {}, b);
  EXPECT_EQ(first.model.slope, second.model.slope);
  EXPECT_EQ(first.inliers, second.inliers);
  EXPECT_EQ(first.iterations, second.iterations);
}

TEST(Ransac, StopsEarlyWithoutOutliers) {
  Random random = test::seeded_random(13);
  const auto result = fit(make_scene(random, 100, 0), {}, random);
  ASSERT_TRUE(result.outcome);
  EXPECT_LE(result.iterations, 10);
}

TEST(Ransac, SaysWhenThereAreTooFewMeasurements) {
  Random random(1);
  RansacOptions options;
  options.min_inliers = 12;
  const auto result = fit(make_scene(random, 11, 0), options, random);
  EXPECT_EQ(result.outcome.code, Outcome::Code::kTooFewData);
  EXPECT_EQ(result.outcome.reason, "11 measurements, 12 needed");
  EXPECT_TRUE(result.inliers.empty());
}

TEST(Ransac, SaysWhenThereIsNoConsensusAndKeepsTheEvidence) {
  Random random = test::seeded_random(14);
  RansacOptions options;
  options.min_inliers = 50;
  const auto result = fit(make_scene(random, 100, 1), options, random);
  EXPECT_EQ(result.outcome.code, Outcome::Code::kNoConsensus);
  EXPECT_FALSE(result.inliers.empty());
  EXPECT_LT(result.inliers.size(), 50u);
  EXPECT_EQ(result.iterations, options.max_iterations);
}

TEST(Ransac, CountsErrorsThatAreNotNumbersAsOutliers) {
  Random random = test::seeded_random(15);
  Scene scene = make_scene(random, 100, 0.3);
  for (int i = 0; i < 30; ++i) scene.y[i] = std::numeric_limits<double>::quiet_NaN();
  const auto result = fit(scene, {}, random);
  ASSERT_TRUE(result.outcome);
  EXPECT_GE(result.inliers.front(), 30);
}

TEST(RansacIterations, FollowsFischlerAndBolles) {
  // log(1 - 0.99) / log(1 - 0.5^2) = 16.01
  EXPECT_EQ(ransac_iterations(0.5, 2, 0.99, 1000), 17);
  EXPECT_EQ(ransac_iterations(0.5, 8, 0.999, 100), 100);
  EXPECT_EQ(ransac_iterations(1, 5, 0.999, 100), 1);
  EXPECT_EQ(ransac_iterations(0, 5, 0.999, 100), 100);
  EXPECT_EQ(ransac_iterations(1e-80, 5, 0.999, 100), 100);
}

TEST(RansacOptions, CheckNamesTheField) {
  RansacOptions options;
  EXPECT_NO_THROW(options.check());
  options.confidence = 1;
  EXPECT_THROW(options.check(), ArgumentError);
  options = {};
  options.max_iterations = 0;
  EXPECT_THROW(options.check(), ArgumentError);
}

}  // namespace ransac_test
}  // namespace placegraph
