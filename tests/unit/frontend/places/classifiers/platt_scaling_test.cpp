#include <gtest/gtest.h>
#include <placegraph/frontend/places/classifiers/platt_scaling.h>
#include <placegraph/graph/core/random.h>

#include <cmath>
#include <utility>

namespace placegraph {
namespace platt_scaling_test {

struct Outputs {
  Eigen::VectorXd values;
  Eigen::Array<bool, Eigen::Dynamic, 1> positive;
};

Outputs draw_outputs(int count, Random& random) {
  Outputs outputs{Eigen::VectorXd(count), Eigen::Array<bool, Eigen::Dynamic, 1>(count)};
  for (int i = 0; i < count; ++i) {
    outputs.positive[i] = i % 4 == 0;
    outputs.values[i] = random.normal(outputs.positive[i] ? 1 : -0.5, 1);
  }
  return outputs;
}

TEST(PlattScalingFit, HasTheLeastCrossEntropyToItsTargets) {
  Random random(1);
  for (const int count : {8, 40, 200}) {
    const Outputs outputs = draw_outputs(count, random);
    const double ones = count / 4.0, zeros = count - ones;
    const auto cost = [&](const PlattScaling& scaling) {
      double sum = 0;
      for (int i = 0; i < count; ++i) {
        const double target = outputs.positive[i] ? (ones + 1) / (ones + 2) : 1 / (zeros + 2);
        const double p = scaling.probability(outputs.values[i]);
        sum -= target * std::log(p) + (1 - target) * std::log(1 - p);
      }
      return sum;
    };
    const PlattScaling best = fit_platt_scaling(outputs.values, outputs.positive);
    EXPECT_LT(best.slope, 0);  // larger outputs are more certain here
    for (const auto& [slope, offset] :
         {std::pair{0.01, 0.0}, {-0.01, 0.0}, {0.0, 0.01}, {0.0, -0.01}, {0.01, -0.01}})
      EXPECT_GT(cost({best.slope + slope, best.offset + offset}), cost(best)) << count;
  }
}

TEST(PlattScalingFit, FollowsTheUnitsAndSignOfTheOutputs) {
  Random random(2);
  const Outputs outputs = draw_outputs(60, random);
  const PlattScaling once = fit_platt_scaling(outputs.values, outputs.positive);
  const PlattScaling scaled =
      fit_platt_scaling((3 - 2 * outputs.values.array()).matrix(), outputs.positive);
  // The iterations end at a gradient of 1e-5, of a curvature of some ones.
  for (const double output : {-2.0, 0.0, 1.5})
    EXPECT_NEAR(scaled.probability(3 - 2 * output), once.probability(output), 1e-4);
  const PlattScaling flipped = fit_platt_scaling(outputs.values, !outputs.positive);
  for (const double output : {-2.0, 0.0, 1.5})
    EXPECT_NEAR(flipped.probability(output), 1 - once.probability(output), 1e-4);
}

TEST(PlattScalingFit, GivesTheShareOfAClassWhereOutputsSayNothing) {
  Eigen::VectorXd equal = Eigen::VectorXd::Constant(12, 0.7);
  Eigen::Array<bool, Eigen::Dynamic, 1> positive =
      Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(12, false);
  positive.head(3) = true;
  // Targets of 4 / 5 and 1 / 11.
  EXPECT_NEAR(fit_platt_scaling(equal, positive).probability(0.7),
              (3 * 4 / 5.0 + 9 * 1 / 11.0) / 12, 1e-5);
}

TEST(PlattScalingProbability, StaysInRangeForAnyOutput) {
  const PlattScaling scaling{-2, 1};
  EXPECT_DOUBLE_EQ(scaling.probability(0.5), 0.5);
  EXPECT_DOUBLE_EQ(scaling.probability(1e6), 1);
  EXPECT_DOUBLE_EQ(scaling.probability(-1e6), 0);
  EXPECT_NEAR(scaling.probability(2) + scaling.probability(-1), 1, 1e-15);  // x of -3 and 3
}

}  // namespace platt_scaling_test
}  // namespace placegraph
