#include <gtest/gtest.h>
#include <placegraph/frontend/vanishing/vanishing_model.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <numbers>

#include "tests/support/scenes/manhattan_scene.h"

namespace placegraph {
namespace vanishing_model_test {

const Camera kCamera = test::vanishing_camera();

TEST(TangentBasisOf, CompletesEveryDirectionToARightHandedFrame) {
  Random random(1);
  for (int round = 0; round < 20; ++round) {
    const Eigen::Vector3d v = test::random_rotation(3, random) * Eigen::Vector3d::UnitZ();
    Eigen::Matrix3d frame;
    frame << tangent_basis(v), v;
    EXPECT_LT((frame.transpose() * frame - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_NEAR(frame.determinant(), 1, 1e-12);
  }
}

TEST(EntropyTerm, SumsToTheEntropyOfTheShares) {
  EXPECT_EQ(entropy_term(0, 5), 0);
  EXPECT_EQ(entropy_term(5, 5), 0);
  // Four equal shares of eight lines: eight times two bits.
  EXPECT_NEAR(4 * entropy_term(2, 8), 8 * std::log(4), 1e-12);
}

TEST(LogRatio, IsADensityOverTheAngles) {
  // A level segment of 60 px, and directions at infinity all around it: the density over that of a
  // uniform one, 1 / pi, has an integral of one. It is in the sine, so that tails count for less.
  const VanishingEvidence evidence({{{300, 240}, {360, 240}}}, kCamera, {});
  constexpr int kSteps = 40000;
  double sum = 0, mean = 0;
  for (int k = 0; k < kSteps; ++k) {
    const double angle = std::numbers::pi * ((k + 0.5) / kSteps - 0.5);
    const double share =
        std::exp(evidence.log_ratio(0, {std::cos(angle), std::sin(angle), 0})) / kSteps;
    sum += share, mean += angle * share;
  }
  EXPECT_NEAR(sum, 1, 1e-3);
  EXPECT_NEAR(mean, 0, 1e-9);
  // An uncertain direction: of the same integral, and lower.
  EXPECT_NEAR(evidence.log_ratio(0, {1, 0, 0}, 0.1) - evidence.log_ratio(0, {1, 0, 0}),
              -0.5 * std::log1p(0.1 * 0.1 / evidence.error(0, {1, 0, 0}).variance), 1e-9);
}

TEST(QuickGains, AreTheNormalDensityOverTheUniformOne) {
  Random random(2);
  std::vector<LineSegment> segments;
  test::add_clutter(kCamera, 30, random, segments);
  const VanishingEvidence evidence(segments, kCamera, {});
  const Eigen::Vector3d v = Eigen::Vector3d(1, 0.2, 0).normalized();  // at infinity: no shift
  Eigen::ArrayXf gains(30);
  evidence.quick_gains(v, 0.5, gains);
  for (int i = 0; i < 30; ++i) {
    const PointingError e = evidence.error(i, v);
    const double gain = std::log(std::numbers::pi) -
                        0.5 * std::log(2 * std::numbers::pi * e.variance) -
                        0.5 * e.sine * e.sine / e.variance - 0.5;
    EXPECT_NEAR(gains[i], evidence.weight(i) * std::max(0.0, gain), 1e-3) << i;
  }
}

TEST(FitNoise, FindsTheNoiseOfTheEnds) {
  Random random(3);
  const Eigen::Vector3d v = Eigen::Vector3d(0.2, 0.1, 1).normalized();
  for (const double end_px : {0.2, 0.6}) {
    std::vector<LineSegment> segments;
    test::add_edges(kCamera, v, 400, end_px, random, segments);
    VanishingEvidence evidence(segments, kCamera, {});
    const std::vector<int> all(static_cast<std::size_t>(evidence.size()), 0);
    evidence.fit_noise({v}, all);
    // The steps of the search are a sixth; a Student distribution with four degrees of freedom has
    // less spread than the normal noise that it fits, by about a sixth too.
    EXPECT_NEAR(evidence.noise().end_px / end_px, 0.9, 0.25);
    EXPECT_THROW(evidence.fit_noise({v}, {0}), ArgumentError);
  }
}

TEST(FitDirection, ErrsByWhatItsCovarianceSays) {
  Random random(4);
  double chi2 = 0;
  constexpr int kRuns = 60;
  for (int run = 0; run < kRuns; ++run) {
    Eigen::Vector3d v = test::random_rotation(3, random) * Eigen::Vector3d::UnitZ();
    if (v.z() < 0) v = -v;
    VanishingNoise noise;
    noise.end_px = 0.3, noise.parallel_deg = 1e-3, noise.tail_freedom = 50;
    std::vector<LineSegment> segments;
    test::add_edges(kCamera, v, 25, noise.end_px, random, segments);
    const VanishingEvidence evidence(segments, kCamera, noise);
    std::vector<int> lines;
    for (int i = 0; i < evidence.size(); ++i) lines.push_back(i);
    const SO3 beside = test::random_rotation(0.05, random);
    const FittedDirection fit = fit_direction(evidence, beside * v, lines, 6);
    ASSERT_TRUE(fit.ok);
    EXPECT_NEAR(fit.v.norm(), 1, 1e-12);
    EXPECT_NEAR((fit.covariance * fit.v).norm(), 0, 1e-12);
    const TangentBasis B = tangent_basis(fit.v);
    const Eigen::Vector2d off = B.transpose() * (fit.v.dot(v) < 0 ? Eigen::Vector3d(-v) : v);
    chi2 += off.dot((B.transpose() * fit.covariance * B).inverse() * off);
  }
  // Two degrees of freedom each: the mean deviates by 2 / sqrt(60) = 0.26.
  EXPECT_NEAR(chi2 / kRuns, 2, 0.9);
}

TEST(FitDirection, IsOpenForLinesThatDoNotMeet) {
  const VanishingEvidence evidence({{{100, 100}, {180, 100}}, {{300, 100}, {420, 100}}}, kCamera,
                                   {});
  EXPECT_FALSE(fit_direction(evidence, {1, 0, 0}, {0}, 3).ok);
  EXPECT_FALSE(fit_direction(evidence, {1, 0, 0}, {0, 1}, 3).ok);  // on one line
}

TEST(VanishingModel, ExplainsEdgesCheaperAndReturnsToNothing) {
  Random random(5);
  std::vector<LineSegment> segments;
  const Eigen::Vector3d a = Eigen::Vector3d(0.1, 0.05, 1).normalized(), b(1, 0, 0);
  test::add_edges(kCamera, a, 20, 0.2, random, segments);
  test::add_edges(kCamera, b, 20, 0.2, random, segments);
  const VanishingEvidence evidence(segments, kCamera, {});
  const VanishingModel empty(evidence, 8, 4);
  EXPECT_EQ(empty.cost(), 0);
  const auto one = empty.with(a);
  ASSERT_TRUE(one);
  const auto two = one->with(b);
  ASSERT_TRUE(two);
  EXPECT_LT(one->cost(), 0);
  EXPECT_LT(two->cost(), one->cost());
  ASSERT_EQ(two->of().size(), 40u);
  int right = 0;
  for (int i = 0; i < 40; ++i) right += two->of()[static_cast<std::size_t>(i)] == i / 20;
  EXPECT_GE(right, 36);  // some edges point at both
  EXPECT_EQ(two->lines_of(0).size() + two->lines_of(1).size() + two->lines_of(-1).size(), 40u);
  // The first goes: the second moves up to its number, with its lines.
  const VanishingModel second = two->without(0, 1);
  ASSERT_EQ(second.size(), 1);
  EXPECT_GT(std::abs(second.directions()[0].v.dot(b)), 0.999);
  EXPECT_NEAR(second.without(0, 1).cost(), 0, 1e-9);
  // A direction that no edge has wins too few lines.
  EXPECT_FALSE(empty.with(Eigen::Vector3d(0.02, 1, 0.01).normalized()));
  // The same directions, in the other order, cost the same.
  const VanishingModel turned = empty.with_all({two->directions()[1], two->directions()[0]});
  EXPECT_NEAR(turned.cost(), empty.with_all(two->directions()).cost(), 1e-9);
}

TEST(SpreadLabels, ReturnsToTheSegmentsThatWereGiven) {
  std::vector<int> labels = {2, 0, -1};
  const VanishingEvidence evidence(
      {{{10, 10}, {60, 30}}, {{100, 50}, {100, 90}}, {{200, 300}, {300, 280}}}, kCamera, {});
  spread_labels(evidence, 5, labels);
  EXPECT_EQ(labels, (std::vector<int>{2, 0, -1, -1, -1}));
}

}  // namespace vanishing_model_test
}  // namespace placegraph
