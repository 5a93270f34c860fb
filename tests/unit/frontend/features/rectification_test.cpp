#include <gtest/gtest.h>
#include <placegraph/frontend/features/rectification.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <cmath>

namespace placegraph {
namespace rectification_test {

constexpr double kSigmaPx = 0.3;

/// Points at disparities of 2 to 50 px all over the image, as a motion whose unit is `scale` too
/// short shows them; every `outlier_every`-th one is wrong by pixels.
std::vector<DisparitySample> samples_of(const RectificationError& error, double scale, int count,
                                        std::uint64_t seed, int outlier_every = 0) {
  Random random(seed, 0);
  std::vector<DisparitySample> samples;
  for (int i = 0; i < count; ++i) {
    DisparitySample& s = samples.emplace_back();
    s.ray = {random.uniform(-0.85, 0.85), random.uniform(-0.25, 0.25)};
    const double truth = std::exp(random.uniform(std::log(2.0), std::log(50.0)));
    s.sigma_px = kSigmaPx;
    s.measured_px = truth + error.at(s.ray) + kSigmaPx * random.normal();
    s.from_motion_px = truth / scale;
    if (outlier_every > 0 && i % outlier_every == 0) s.measured_px += random.uniform(2, 12);
  }
  return samples;
}

/// Deviation of the estimate in units of its covariance: chi2 with 3 degrees of freedom.
double mahalanobis2(const RectificationEstimator& estimator, const RectificationError& truth) {
  const RectificationError e = estimator.error();
  const Eigen::Vector3d d(e.offset_px - truth.offset_px, e.by_x_px - truth.by_x_px,
                          e.by_y_px - truth.by_y_px);
  return d.dot(estimator.covariance().inverse() * d);
}

TEST(RectificationError, IsAnOffsetThatGrowsOverTheImage) {
  EXPECT_DOUBLE_EQ((RectificationError{0.1, -0.2, 0.4}.at({0.5, -0.25})), 0.1 - 0.1 - 0.1);
}

TEST(RectificationEstimator, KnowsNothingBeforeItHasSeenAnything) {
  RectificationOptions options;
  options.prior_sigma_px = 0.4;
  const RectificationEstimator estimator(options);
  EXPECT_EQ(estimator.error().at({0.3, 0.1}), 0);
  EXPECT_TRUE(estimator.covariance().isApprox(0.16 * Eigen::Matrix3d::Identity()));
}

TEST(RectificationEstimator, TellsAnOffsetFromAWrongUnit) {
  const RectificationError truth{-0.2, -0.35, 0.3};
  for (const double scale : {0.96, 1.0, 1.03}) {
    RectificationEstimator estimator({});
    for (int batch = 0; batch < 10; ++batch)
      estimator.add(samples_of(truth, scale, 150, 17 + batch));
    // 1500 points of 0.3 px: hundredths, but for what the batches have in common (0.1 px each).
    EXPECT_NEAR(estimator.error().offset_px, truth.offset_px, 0.06) << scale;
    EXPECT_NEAR(estimator.error().by_x_px, truth.by_x_px, 0.06) << scale;
    EXPECT_NEAR(estimator.error().by_y_px, truth.by_y_px, 0.12) << scale;
    EXPECT_LT(mahalanobis2(estimator, truth), 16.3) << scale;  // 99.9 %
  }
}

TEST(RectificationEstimator, IsNotMovedByOneWrongPointInFour) {
  const RectificationError truth{0.15, 0, 0};
  RectificationEstimator estimator({});
  for (int batch = 0; batch < 10; ++batch) estimator.add(samples_of(truth, 1, 200, 71 + batch, 4));
  EXPECT_NEAR(estimator.error().offset_px, truth.offset_px, 0.1);
}

TEST(RectificationEstimator, TellsNothingFromPointsOfOneDisparity) {
  RectificationEstimator estimator({});
  std::vector<DisparitySample> one_depth(60);
  for (std::size_t i = 0; i < one_depth.size(); ++i)
    one_depth[i] = {{0.01 * static_cast<double>(i) - 0.3, 0.02}, 40.2, 40, kSigmaPx};
  estimator.add(one_depth);
  // A unit wrong by half a per cent and an offset look the same: 0.3 px of offset against 2 %
  // of 40.
  EXPECT_LT(estimator.error().offset_px, 0.05);
  EXPECT_GT(estimator.covariance()(0, 0), 0.07);
}

TEST(RectificationEstimator, RefusesWhatIsNoDisparity) {
  RectificationEstimator estimator({});
  auto samples = samples_of({}, 1, 30, 3);
  samples[4].measured_px = std::nan("");
  EXPECT_THROW(estimator.add(samples), ArgumentError);
  samples = samples_of({}, 1, 30, 3);
  samples[4].sigma_px = 0;
  EXPECT_THROW(estimator.add(samples), ArgumentError);
  RectificationOptions options;
  options.prior_sigma_px = 0;
  EXPECT_THROW(RectificationEstimator{options}, ArgumentError);
}

}  // namespace rectification_test
}  // namespace placegraph
