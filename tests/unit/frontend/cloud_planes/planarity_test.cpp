#include <gtest/gtest.h>
#include <placegraph/frontend/cloud_planes/planarity.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <cmath>
#include <limits>

#include "tests/support/message_of.h"
#include "tests/support/scenes/small_cloud.h"

namespace placegraph {
namespace planarity_test {

/// Samples of two classes that overlap in every feature; a third are planes.
std::vector<PlanaritySample> draw_samples(int count, Random& random) {
  std::vector<PlanaritySample> samples(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    samples[i].planar = i % 3 == 0;
    for (std::size_t f = 0; f < samples[i].features.size(); ++f)
      samples[i].features[f] =
          random.normal(samples[i].planar ? 0.1 * static_cast<double>(f) : 0, 1);
  }
  return samples;
}

/// Weights of GentleBoost after the stumps of a model, from their definition.
std::vector<double> weights_after(const std::vector<PlanaritySample>& samples,
                                  const std::vector<PlanarityModel::Stump>& stumps) {
  double planes = 0;
  for (const PlanaritySample& sample : samples) planes += sample.planar;
  std::vector<double> weights;
  for (const PlanaritySample& sample : samples) {
    double votes = 0;
    for (const PlanarityModel::Stump& stump : stumps)
      votes += sample.features[static_cast<std::size_t>(stump.feature)] < stump.threshold
                   ? stump.below
                   : stump.above;
    weights.push_back(std::exp(sample.planar ? -votes : votes) /
                      (sample.planar ? planes : static_cast<double>(samples.size()) - planes));
  }
  return weights;
}

/// Weighted squared error of the best votes on both sides of a threshold.
double error_of(const std::vector<PlanaritySample>& samples, const std::vector<double>& weights,
                int feature, double threshold) {
  double sum[2] = {0, 0}, squares[2] = {0, 0}, products[2] = {0, 0};
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool above = !(samples[i].features[static_cast<std::size_t>(feature)] < threshold);
    const double target = samples[i].planar ? 1 : -1;
    sum[above] += weights[i], squares[above] += weights[i] * target * target;
    products[above] += weights[i] * target;
  }
  double error = 0;
  for (const int side : {0, 1})
    if (sum[side] > 0) error += squares[side] - products[side] * products[side] / sum[side];
  return error;
}

TEST(TrainPlanarity, AddsTheStumpOfLeastSquaresEveryRound) {
  Random random(1);
  const std::vector<PlanaritySample> samples = draw_samples(45, random);
  const PlanarityModel model = train_planarity(samples, 4);
  ASSERT_EQ(model.stumps.size(), 4u);
  for (std::size_t round = 0; round < 4; ++round) {
    const PlanarityModel::Stump& stump = model.stumps[round];
    const std::vector<double> weights =
        weights_after(samples, {model.stumps.begin(), model.stumps.begin() + round});
    double least = std::numeric_limits<double>::infinity();
    for (int feature = 0; feature < kPlanarityFeatures; ++feature)
      for (const PlanaritySample& at : samples)
        least = std::min(least, error_of(samples, weights, feature,
                                         at.features[static_cast<std::size_t>(feature)]));
    EXPECT_NEAR(error_of(samples, weights, stump.feature, stump.threshold), least, 1e-12);
    // Its votes are the weighted means of the classes, 1 and -1, on either side.
    double sum = 0, mean = 0;
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (samples[i].features[static_cast<std::size_t>(stump.feature)] < stump.threshold)
        sum += weights[i], mean += samples[i].planar ? weights[i] : -weights[i];
    EXPECT_NEAR(stump.below, mean / sum, 1e-12);
  }
}

TEST(TrainPlanarity, NeverRaisesTheExponentialLoss) {
  // In each region the factor of the loss is p exp(-m) + q exp(m) with m = p - q, at most 1.
  Random random(2);
  const std::vector<PlanaritySample> samples = draw_samples(60, random);
  const PlanarityModel model = train_planarity(samples, 30);
  double last = 2;  // both classes weigh 1
  for (std::size_t round = 1; round <= model.stumps.size(); ++round) {
    double loss = 0;
    for (const double w :
         weights_after(samples, {model.stumps.begin(), model.stumps.begin() + round}))
      loss += w;
    EXPECT_LT(loss, last) << round;
    last = loss;
  }
}

TEST(TrainPlanarity, DoesNotCareForCopiesOfAClassOrUnitsOfAFeature) {
  Random random(3);
  const std::vector<PlanaritySample> samples = draw_samples(40, random);
  std::vector<PlanaritySample> other;
  for (const PlanaritySample& sample : samples)
    for (int copy = 0; copy < (sample.planar ? 3 : 1); ++copy) {
      other.push_back(sample);
      for (double& f : other.back().features) f = 8 * f - 4;
    }
  const PlanarityModel a = train_planarity(samples, 8), b = train_planarity(other, 8);
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_EQ(a.stumps[k].feature, b.stumps[k].feature);
    EXPECT_NEAR(8 * a.stumps[k].threshold - 4, b.stumps[k].threshold, 1e-12);
    EXPECT_NEAR(a.stumps[k].below, b.stumps[k].below, 1e-9);
    EXPECT_NEAR(a.stumps[k].above, b.stumps[k].above, 1e-9);
  }
}

TEST(TrainPlanarity, NeedsBothClasses) {
  std::vector<PlanaritySample> samples(3);
  for (const bool planar : {false, true}) {
    for (PlanaritySample& sample : samples) sample.planar = planar;
    EXPECT_NE(
        test::message_of<ArgumentError>([&] { (void)train_planarity(samples); }).find("both kinds"),
        std::string::npos);
  }
}

TEST(PlanarityModel, AddsTheVotesOfItsStumps) {
  PlanarityFeatures features{};
  EXPECT_DOUBLE_EQ(PlanarityModel{}.probability(features), 0.5);
  const PlanarityModel model{{{2, 1.5, -0.3, 0.4}, {5, 0, 0.1, -0.2}}};
  features[2] = 1.5;  // a value at the threshold is above it
  features[5] = -1;
  EXPECT_DOUBLE_EQ(model.probability(features), 1 / (1 + std::exp(-2 * 0.5)));
  features[2] = 1.4999;
  EXPECT_DOUBLE_EQ(model.probability(features), 1 / (1 + std::exp(2 * 0.2)));
}

TEST(PlanarityModel, IsTheSameModelAfterItsText) {
  Random random(4);
  PlanarityModel model;
  for (int k = 0; k < 40; ++k)
    model.stumps.push_back({random.index(kPlanarityFeatures), random.normal(0, 1e3),
                            random.normal(0, 1e-7), random.uniform()});
  const PlanarityModel again = parse_planarity("# a comment\n\n" + to_text(model), "model.txt");
  ASSERT_EQ(again.stumps.size(), model.stumps.size());
  for (std::size_t k = 0; k < model.stumps.size(); ++k) {
    EXPECT_EQ(again.stumps[k].feature, model.stumps[k].feature);
    EXPECT_EQ(again.stumps[k].threshold, model.stumps[k].threshold);
    EXPECT_EQ(again.stumps[k].below, model.stumps[k].below);
    EXPECT_EQ(again.stumps[k].above, model.stumps[k].above);
  }
}

TEST(PlanarityModel, NamesTheLineThatIsNone) {
  for (const char* line : {"other 1 2 3", "misfit 1 2", "misfit 1 2 3 4", "misfit 1 two 3",
                           "misfit 1e999 2 3", "planarity 14", "planarity"})
    EXPECT_EQ(test::message_of([&] {
                (void)parse_planarity("# first\nmisfit 1 2 3\n" + std::string(line), "m.txt");
              }).find("m.txt:3: "),
              0u)
        << line;
}

PlanarityFeatures features_of(const PointCloud& cloud) {
  const CloudPoints points = prepare_cloud(cloud, 3e-4);
  const SuperPoints super_points = make_super_points(points);
  std::vector<int> planar;
  for (std::size_t c = 0; c < super_points.cells.size(); ++c)
    if (super_points.cells[c].planar) planar.push_back(static_cast<int>(c));
  return planarity_features(make_segment(planar, super_points, points.model), points, super_points,
                            contacts_of_cells(super_points));
}

TEST(PlanarityFeatures, StayAtAnyScale) {
  Random random(5);
  PointCloud cloud = test::small_cloud(40, 32, [&](double x, double y) {
    return 2 / (1 + 0.3 * x - 0.2 * y + 0.1 * x * x) * (1 + random.normal(0, 1e-3));
  });
  const PlanarityFeatures once = features_of(cloud);
  for (Eigen::Vector3d& p : cloud.points) p *= 16;
  const PlanarityFeatures again = features_of(cloud);
  for (std::size_t f = 0; f < once.size(); ++f)
    EXPECT_NEAR(once[f], again[f], 1e-6) << planarity_feature_names()[f];
}

TEST(PlanarityFeatures, OfAWholePlaneAreThoseOfItsNoise) {
  Random random(6);
  const PlanarityFeatures features = features_of(test::small_cloud(48, 48, [&](double x, double y) {
    return 2 / (1 + 0.3 * x - 0.2 * y) * (1 + random.normal(0, 2e-3));
  }));
  const auto feature = [&](const std::string& name) {
    for (std::size_t f = 0; f < features.size(); ++f)
      if (planarity_feature_names()[f] == name) return features[f];
    ADD_FAILURE() << name;
    return 0.0;
  };
  EXPECT_NEAR(feature("size"), std::log(48.0 * 48), 1e-12);
  EXPECT_NEAR(feature("misfit"), 0, 0.3);  // the noise is known to a tenth
  // Shares of a normal distribution within one, beyond two deviations, of 256 samples: three
  // deviations are 0.09 and 0.04, and as much again for the noise.
  EXPECT_NEAR(feature("near"), 0.683, 0.15);
  EXPECT_NEAR(feature("far"), 0.046, 0.07);
  EXPECT_NEAR(feature("alike"), 1, 1e-9);
  EXPECT_EQ(feature("border"), 0);    // nothing is beyond it
  EXPECT_LT(feature("curved"), 0.1);  // five numbers fitted to 256 residuals: 0.02
}

}  // namespace planarity_test
}  // namespace placegraph
