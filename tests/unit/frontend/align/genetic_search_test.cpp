#include <gtest/gtest.h>
#include <placegraph/frontend/align/genetic_search.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/message_of.h"

namespace placegraph {
namespace genetic_search_test {

/// A bent valley.
double valley(const Eigen::VectorXd& x) {
  double sum = 0;
  for (Eigen::Index i = 0; i + 1 < x.size(); ++i)
    sum += 10 * std::pow(x[i + 1] - x[i] * x[i], 2) + std::pow(1 - x[i], 2);
  return sum;
}

TEST(GeneticSearchResult, IsTheBestPointThatWasEvaluated) {
  GeneticOptions options;
  options.members = 12;
  for (const int generations : {1, 5, 20}) {
    options.generations = generations;
    int evaluations = 0;
    double least = std::numeric_limits<double>::infinity(), first = -1;
    const PopulationResult found = genetic_search(
        [&](const Eigen::VectorXd& x) {
          EXPECT_LE(x.cwiseAbs().maxCoeff(), options.bound);
          const double cost = valley(x);
          if (evaluations++ == 0) first = cost;
          least = std::min(least, cost);
          return cost;
        },
        3, options);
    EXPECT_EQ(first, valley(Eigen::Vector3d::Zero()));  // it starts at the origin
    EXPECT_EQ(found.costs[0], least);
    EXPECT_EQ(found.evaluations, evaluations);
    EXPECT_EQ(evaluations, 12 + found.generations * (12 - options.elite));
    for (std::size_t i = 0; i < found.points.size(); ++i)
      EXPECT_EQ(found.costs[i], valley(found.points[i]));
    EXPECT_TRUE(std::is_sorted(found.costs.begin(), found.costs.end()));
  }
}

TEST(GeneticSearchResult, NeverGetsWorseWithMoreGenerations) {
  GeneticOptions options;
  double last = std::numeric_limits<double>::infinity();
  for (int generations = 1; generations < 16; generations += 3) {
    options.generations = generations;
    const double cost = genetic_search(valley, 4, options).costs[0];
    EXPECT_LE(cost, last);
    last = cost;
  }
  EXPECT_LT(last, valley(Eigen::Vector4d::Zero()));
}

TEST(GeneticSearchResult, EndsWithoutProgressAndRefusesWhatCannotBe) {
  GeneticOptions options;
  options.stagnation = 4;
  const auto flat = [](const Eigen::VectorXd&) { return 2.0; };
  EXPECT_EQ(genetic_search(flat, 2, options).generations, 4);
  EXPECT_THROW(genetic_search(flat, 0, options), ArgumentError);
  options.elite = options.members;
  EXPECT_NE(
      test::message_of<ArgumentError>([&] { genetic_search(flat, 2, options); }).find("elite"),
      std::string::npos);
}

}  // namespace genetic_search_test
}  // namespace placegraph
