#include <gtest/gtest.h>
#include <placegraph/frontend/planes/label_expansion.h>
#include <placegraph/graph/core/error.h>

#include <cmath>

#include "tests/support/seed.h"

namespace placegraph {
namespace label_expansion_test {

TEST(LabelExpansion, TakesTheCheapestLabelOfEachItemWhereNothingJoinsThem) {
  LabelProblem problem;
  problem.unary.resize(3, 3);
  problem.unary << 1, 2, 3, 5, 0, 1, 4, 4, -1;
  std::vector<int> labels = {2, 2, 0};
  EXPECT_DOUBLE_EQ(expand_labels(problem, labels), 0);
  EXPECT_EQ(labels, (std::vector<int>{0, 1, 2}));
}

TEST(LabelExpansion, FollowsTheNeighboursWhereTheyWeighMore) {
  LabelProblem problem;
  problem.unary.resize(3, 2);
  problem.unary << 0, 5, 1, 0, 0, 5;  // the one in the middle would rather have label 1
  problem.neighbours = {{0, 1}, {1, 2}};
  std::vector<int> labels = {0, 1, 0};
  problem.pair_cost = 0.4;
  EXPECT_DOUBLE_EQ(expand_labels(problem, labels), 0.8);
  EXPECT_EQ(labels, (std::vector<int>{0, 1, 0}));
  problem.pair_cost = 0.6;
  EXPECT_DOUBLE_EQ(expand_labels(problem, labels), 1);
  EXPECT_EQ(labels, (std::vector<int>{0, 0, 0}));
}

TEST(LabelExpansion, FindsTheBestOfTwoLabelsAndNeverMoreThanTwiceTheBestOfThree) {
  // With two labels one cut is exact; with more the answer costs at most twice the least (Boykov,
  // Veksler & Zabih 2001, theorem 6.1). All labellings are tried.
  Random random = test::seeded_random(65);
  for (int run = 0; run < 30; ++run) {
    const int n = 7, kinds = 2 + run % 2;
    LabelProblem problem;
    problem.unary.resize(n, kinds);
    for (int i = 0; i < n; ++i)
      for (int l = 0; l < kinds; ++l) problem.unary(i, l) = random.uniform(0, 2);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < i; ++j)
        if (random.uniform() < 0.4) problem.neighbours.emplace_back(i, j);
    problem.pair_cost = random.uniform(0, 1);
    double least = 1e9;
    std::vector<int> labels(n, 0);
    const int all = static_cast<int>(std::pow(kinds, n));
    for (int code = 0; code < all; ++code) {
      for (int i = 0, rest = code; i < n; ++i, rest /= kinds) labels[i] = rest % kinds;
      least = std::min(least, label_cost(problem, labels));
    }
    std::fill(labels.begin(), labels.end(), 0);
    const double cost = expand_labels(problem, labels);
    EXPECT_DOUBLE_EQ(cost, label_cost(problem, labels));
    EXPECT_LE(cost, (kinds == 2 ? 1 : 2) * least + 1e-9);
  }
}

TEST(LabelExpansion, RefusesProblemsThatDoNotFit) {
  std::vector<int> labels = {0, 0};
  EXPECT_THROW(expand_labels({Eigen::MatrixXd::Zero(3, 2), {}, 0}, labels), ArgumentError);
  EXPECT_THROW(expand_labels({Eigen::MatrixXd::Zero(2, 2), {}, -1}, labels), ArgumentError);
}

}  // namespace label_expansion_test
}  // namespace placegraph
