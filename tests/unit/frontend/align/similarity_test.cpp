#include <gtest/gtest.h>
#include <placegraph/frontend/align/joint_histogram.h>
#include <placegraph/frontend/align/similarity.h>

#include <cmath>

#include "tests/support/seed.h"

namespace placegraph {
namespace similarity_test {

using test::seeded_random;
using Values = std::vector<double>;

Values map_values(const Values& values, double (*f)(double)) {
  Values mapped;
  for (const double value : values) mapped.push_back(f(value));
  return mapped;
}

Values random_values(int n, Random& random) {
  Values values;
  for (int i = 0; i < n; ++i) values.push_back(random.uniform(20, 230));
  return values;
}

TEST(Similarity, OfThreeValuesIsAsComputedByHand) {
  const Values ref = {1, 2, 3}, cur = {3, 5, 10};
  EXPECT_NEAR(similarity(Similarity::kSsd, ref, cur), -(4 + 9 + 49) / 3.0, 1e-12);
  // Covariance 7, variances 2 and 26.
  EXPECT_NEAR(similarity(Similarity::kZncc, ref, cur), 7 / std::sqrt(52.0), 1e-12);
  // The gain 3.5 is cut to 2: sum (cur - mean)^2 - 4 * 7 + 4 * 2.
  EXPECT_NEAR(similarity(Similarity::kSsdGainBias, ref, cur), -(26 - 28 + 8) / 3.0, 1e-12);
}

TEST(Similarity, ByCorrelationIgnoresGainAndBiasAndByInformationAnyMonotoneMap) {
  Random random = seeded_random(72);
  const Values ref = random_values(4000, random);
  const Values brighter = map_values(ref, [](double v) { return 0.6 * v + 30; });
  const Values inverted = map_values(ref, [](double v) { return 255 - v; });
  const Values other = random_values(4000, random);
  EXPECT_NEAR(similarity(Similarity::kZncc, ref, brighter), 1, 1e-12);
  EXPECT_NEAR(similarity(Similarity::kSsdGainBias, ref, brighter), 0, 1e-9);
  EXPECT_NEAR(similarity(Similarity::kZncc, ref, inverted), -1, 1e-12);
  const double same = similarity(Similarity::kMi, ref, ref);
  EXPECT_NEAR(similarity(Similarity::kMi, ref, brighter), same, 1e-6);
  EXPECT_NEAR(similarity(Similarity::kMi, ref, inverted), same, 1e-6);
  EXPECT_GT(same, 1);
  EXPECT_LT(similarity(Similarity::kMi, ref, other), 0.05);
}

TEST(Similarity, OfNothingIsTheWorst) {
  EXPECT_EQ(similarity(Similarity::kZncc, {}, {}), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(similarity(Similarity::kZncc, {3, 3, 3}, {1, 2, 3}), 0);
}

TEST(JointHistogram, HasADerivativeThatAgreesWithFiniteDifferences) {
  Random random = seeded_random(73);
  const Values ref = random_values(300, random);
  Values cur;
  for (const double v : ref) cur.push_back(0.7 * v + 20 + random.normal(0, 12));
  // The ends fix the range; they are not moved.
  Values mean(300), slope(300), residual(300);
  JointHistogram(ref, cur).linearize(ref, cur, mean, slope, residual);
  const auto [least, greatest] = std::minmax_element(cur.begin(), cur.end());
  double ratio = 0;
  int used = 0;
  for (std::size_t i = 0; i < 40; ++i) {
    if (cur[i] < *least + 1 || cur[i] > *greatest - 1 || std::abs(residual[i]) < 2) continue;
    Values up = cur, down = cur;
    up[i] += 1e-3, down[i] -= 1e-3;
    const double numeric = (JointHistogram(ref, up).mutual_information() -
                            JointHistogram(ref, down).mutual_information()) /
                           2e-3;
    // residual = -N s^2 dMI/dcur: the factor must be one and the same for all samples.
    const double factor = -residual[i] / numeric;
    if (ratio == 0) ratio = factor;
    EXPECT_NEAR(factor / ratio, 1, 0.02) << i;
    ++used;
  }
  EXPECT_GT(used, 10);
  EXPECT_GT(ratio, 0);
}

TEST(PhotometricFit, FindsGainAndBiasUnderOcclusion) {
  Random random = seeded_random(74);
  const Values ref = random_values(1000, random);
  Values cur;
  for (std::size_t i = 0; i < ref.size(); ++i)
    cur.push_back(i % 4 == 0 ? 10.0 : 0.8 * ref[i] + 15 + random.normal(0, 1));
  PhotometricFit fit;
  for (int i = 0; i < 12; ++i)
    fit_photometry(Similarity::kSsdGainBias, ref, cur, RobustKernel::Kind::kTukey, 4.685, fit);
  // 750 values of sigma 1 over a spread of 60: 0.0006 for the gain, 0.09 for the bias.
  EXPECT_NEAR(fit.gain, 0.8, 0.004);
  EXPECT_NEAR(fit.bias, 15, 0.6);
  EXPECT_NEAR(fit.inlier_share, 0.75, 0.05);
  EXPECT_GT(agreement(fit, cur), 0.99);
  EXPECT_EQ(fit.weight[0], 0);
}

}  // namespace similarity_test
}  // namespace placegraph
