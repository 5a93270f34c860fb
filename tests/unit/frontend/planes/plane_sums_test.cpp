#include <gtest/gtest.h>
#include <placegraph/frontend/cloud_planes/neighbour_tree.h>
#include <placegraph/frontend/cloud_planes/normalized_cuts.h>
#include <placegraph/frontend/cloud_planes/planarity.h>
#include <placegraph/frontend/planes/plane_sums.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "tests/support/message_of.h"

namespace placegraph {
namespace plane_sums_test {

FitPoint along_ray(const Eigen::Vector3d& p, double weight) {
  return {p / p.z(), 1 / p.z(), weight};
}

TEST(PlaneSums, FitExactPlanesInBothForms) {
  Random random(5);
  const Eigen::Vector3d n = Eigen::Vector3d(0.3, -0.5, 0.8).normalized();
  for (const PointNoise noise : {PointNoise::kAlongRay, PointNoise::kIsotropic}) {
    const FitModel model{noise, 0};
    PlaneSums first, second;
    for (int i = 0; i < 40; ++i) {
      Eigen::Vector3d p(random.uniform(-1, 1), random.uniform(-1, 1), 0);
      p.z() = (2 - n.head<2>().dot(p.head<2>())) / n.z();
      (i % 2 == 0 ? first : second)
          .add(noise == PointNoise::kAlongRay ? along_ray(p, 1e4) : FitPoint{p, 0, 1e4}, model);
    }
    first += second;
    const FittedPlane fit = first.fit(model, true);
    ASSERT_TRUE(fit.ok);
    EXPECT_NEAR(fit.plane.normal.dot(n), 1, 1e-12);
    EXPECT_NEAR(fit.plane.distance_m, 2, 1e-9);
    EXPECT_NEAR(fit.chi2, 0, 1e-6);
    EXPECT_NEAR(first.misfit(fit, model), 0, 1e-6);
    // The closest point is known well across, as little as the points spread along.
    EXPECT_GT(Eigen::LLT<Eigen::Matrix3d>(fit.covariance).matrixL().determinant(), 0);
  }
}

TEST(PlaneSums, TheirCovarianceIsThatOfManyDraws) {
  Random random(8);
  for (const PointNoise noise : {PointNoise::kAlongRay, PointNoise::kIsotropic}) {
    const FitModel model{noise, 0};
    const double sigma = 0.01;
    const Eigen::Vector3d n = Eigen::Vector3d(0.2, 0.1, 1).normalized(), truth = 3 * n;
    double sum = 0;
    constexpr int kDraws = 200;
    for (int draw = 0; draw < kDraws; ++draw) {
      PlaneSums sums;
      for (int i = 0; i < 60; ++i) {
        Eigen::Vector3d p(random.uniform(-1, 1), random.uniform(-1, 1), 0);
        p.z() = (3 - n.head<2>().dot(p.head<2>())) / n.z();
        if (noise == PointNoise::kAlongRay) {
          const double deviation = sigma / (p.z() * p.z());
          const double value = 1 / p.z() + random.normal(0, deviation);
          sums.add({p / p.z(), value, 1 / (deviation * deviation)}, model);
        } else {
          sums.add({p + n * random.normal(0, sigma), 0, 1 / (sigma * sigma)}, model);
        }
      }
      const FittedPlane fit = sums.fit(model, true);
      const Eigen::Vector3d off = fit.plane.normal * fit.plane.distance_m - truth;
      sum += off.dot(fit.covariance.inverse() * off);
    }
    // The mean of chi2 with 3 degrees of freedom over 200 draws: 3 +- 0.17.
    EXPECT_NEAR(sum / kDraws, 3, 0.7);
  }
}

TEST(PlaneSums, TellThatPointsOfALineAreNoPlane) {
  const FitModel model{PointNoise::kIsotropic, 0};
  PlaneSums sums;
  for (int i = 0; i < 10; ++i) sums.add({{0.1 * i, 0.2 * i, 1.0}, 0, 1}, model);
  EXPECT_FALSE(sums.fit(model).ok);
  EXPECT_FALSE(PlaneSums().fit(model).ok);
  EXPECT_FALSE(plane_through({0, 0, 0}, {1, 1, 1}, {2, 2, 2}).ok);
}

TEST(NeighbourTree, FindsWhatEveryoneIsNearest) {
  Random random(11);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 300; ++i)
    points.emplace_back(random.uniform(), random.uniform(), i % 3 == 0 ? 0 : random.uniform());
  const NeighbourTree tree(points);
  std::vector<int> found;
  for (int i = 0; i < 300; i += 7) {
    std::vector<std::pair<double, int>> all;
    for (int j = 0; j < 300; ++j)
      if (j != i) all.emplace_back((points[i] - points[j]).squaredNorm(), j);
    std::sort(all.begin(), all.end());
    tree.nearest(i, 6, found);
    ASSERT_EQ(found.size(), 6u);
    for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(found[k], all[k].second);
  }
  NeighbourTree({{1, 1, 1}}).nearest(0, 3, found);
  EXPECT_TRUE(found.empty());
}

TEST(NeighbourTree, EqualPointsShareTheirNeighboursEvenly) {
  constexpr int kEqual = 50'000, kSought = 8;
  std::vector<Eigen::Vector3d> points(kEqual, Eigen::Vector3d(1, 2, 3));
  points.emplace_back(1, 2, 4);
  const NeighbourTree tree(points);  // a search among all equal points would take minutes
  std::vector<int> found, sought(points.size(), 0);
  for (int i = 0; i < kEqual; ++i) {
    tree.nearest(i, kSought, found);
    ASSERT_EQ(found.size(), static_cast<std::size_t>(kSought));
    for (const int j : found) {
      ASSERT_NE(j, i);
      ++sought[static_cast<std::size_t>(j)];
    }
  }
  EXPECT_EQ(*std::max_element(sought.begin(), sought.end()), kSought);
  tree.nearest(kEqual, 3, found);
  EXPECT_EQ(found, (std::vector<int>{0, 1, 2}));
}

/// Two chains of `half` nodes, joined weakly in the middle.
std::vector<Affinity> two_chains(int half, double bridge) {
  std::vector<Affinity> edges;
  for (int i = 0; i + 1 < 2 * half; ++i) edges.push_back({i, i + 1, i + 1 == half ? bridge : 1.0});
  for (int i = 0; i + 2 < 2 * half; ++i)
    if (i + 1 != half && i + 2 != half) edges.push_back({i, i + 2, 1.0});
  return edges;
}

TEST(NormalizedCut, CutsWhereTwoPartsHangTogetherLeast) {
  for (const int half : {8, 60}) {  // dense, and by Lanczos iterations
    const auto cut = normalized_cut(2 * half, two_chains(half, 0.05));
    ASSERT_TRUE(cut);
    for (int i = 0; i < 2 * half; ++i) EXPECT_EQ(cut->second[i], cut->second[i < half ? 0 : half]);
    EXPECT_NE(cut->second[0], cut->second[half]);
    // Both sides hold about 2 (2 half - 3) of the affinities.
    EXPECT_NEAR(cut->value, 2 * 0.05 / (2.0 * (2 * half - 3)), 0.2 * cut->value);
  }
  EXPECT_THROW((void)normalized_cut(1, {}), ArgumentError);
  EXPECT_THROW((void)normalized_cut(2, {{0, 2, 1.0}}), ArgumentError);
}

TEST(Planarity, LearnsWhatPartsTheSamplesAndReadsItsText) {
  Random random(2);
  std::vector<PlanaritySample> samples;
  for (int i = 0; i < 200; ++i) {
    PlanaritySample sample;
    sample.planar = i % 4 == 0;
    for (double& f : sample.features) f = random.uniform();
    sample.features[5] = sample.planar ? random.uniform(0, 0.4) : random.uniform(0.6, 1);
    samples.push_back(sample);
  }
  const PlanarityModel model = train_planarity(samples, 5);
  for (const PlanaritySample& sample : samples)
    EXPECT_EQ(model.probability(sample.features) > 0.5, sample.planar);
  const PlanarityModel again = parse_planarity(to_text(model), "m.txt");
  EXPECT_EQ(to_text(again), to_text(model));
  EXPECT_EQ(again.probability(samples[0].features), model.probability(samples[0].features));
  for (PlanaritySample& sample : samples) sample.planar = true;
  EXPECT_THROW((void)train_planarity(samples, 5), ArgumentError);
}

TEST(Planarity, RefusesOtherTexts) {
  using test::message_of;
  EXPECT_FALSE(built_in_planarity().stumps.empty());
  EXPECT_EQ(message_of([] { (void)parse_planarity("planarity 15\nbend 1 2\n", "m.txt"); }),
            "m.txt:2: a stump is: feature threshold below above");
  EXPECT_EQ(message_of([] { (void)parse_planarity("planarity 3\n", "m.txt"); }),
            "m.txt:1: 3 features, this program has 15");
  EXPECT_EQ(message_of([] { (void)parse_planarity("curl 1 2 3\n", "m.txt"); }),
            "m.txt:1: a stump is: feature threshold below above");
  EXPECT_EQ(message_of([] { (void)parse_planarity("bend 1 2 nan\n", "m.txt"); }),
            "m.txt:1: a stump is: feature threshold below above");
}

}  // namespace plane_sums_test
}  // namespace placegraph
