#include <gtest/gtest.h>
#include <placegraph/frontend/align/genetic_search.h>
#include <placegraph/frontend/align/particle_swarm.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <numbers>

namespace placegraph {
namespace particle_swarm_test {

using Eigen::VectorXd;

/// Many local minima on a bowl; the least is 0 at (0.7, 0.7, ...).
double rastrigin(const VectorXd& x) {
  double sum = 0;
  for (const double v : x) {
    const double d = v - 0.7;
    sum += 4 * d * d + 0.5 * (1 - std::cos(2 * std::numbers::pi * d / 0.4));
  }
  return sum;
}

TEST(ParticleSwarm, HasTheConstrictionOfClercAndKennedy) {
  EXPECT_NEAR(constriction(4.1), 0.729844, 1e-6);
}

TEST(ParticleSwarm, FindsTheLeastOfManyMinimaInEveryVariant) {
  for (const SwarmDamping damping : {SwarmDamping::kConstriction, SwarmDamping::kInertia})
    for (const SwarmTopology topology : {SwarmTopology::kGlobal, SwarmTopology::kRing}) {
      SwarmOptions options{damping, topology};
      options.generations = 150;
      options.stagnation = 60;
      const PopulationResult found = swarm_search(rastrigin, 3, options);
      EXPECT_LT((found.points[0].array() - 0.7).abs().maxCoeff(), 0.1);
      EXPECT_EQ(found.costs[0], rastrigin(found.points[0]));
      EXPECT_TRUE(std::is_sorted(found.costs.begin(), found.costs.end()));
    }
}

TEST(ParticleSwarm, GivesTheSameBitsOnAnyNumberOfThreads) {
  SwarmOptions options;
  const PopulationResult one = swarm_search(rastrigin, 6, options);
  options.threads = 4;
  const PopulationResult four = swarm_search(rastrigin, 6, options);
  ASSERT_EQ(one.points.size(), four.points.size());
  EXPECT_EQ(one.generations, four.generations);
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    EXPECT_EQ(one.points[i], four.points[i]);
    EXPECT_EQ(one.costs[i], four.costs[i]);
  }
  options.seed = 2;
  EXPECT_NE(swarm_search(rastrigin, 6, options).points[0], one.points[0]);
}

TEST(ParticleSwarm, StaysWithinItsBoundsAndStopsWhenIdle) {
  SwarmOptions options;
  options.bound = 0.5;
  const PopulationResult found = swarm_search(rastrigin, 2, options);
  for (const VectorXd& x : found.points) EXPECT_LE(x.cwiseAbs().maxCoeff(), 0.5);
  options.stagnation = 3;
  const auto flat = [](const VectorXd&) { return 1.0; };
  EXPECT_EQ(swarm_search(flat, 2, options).generations, 3);
}

TEST(ParticleSwarm, HandsOnWhatTheCostThrows) {
  SwarmOptions options;
  options.threads = 2;
  const auto broken = [](const VectorXd&) -> double { throw ArgumentError("broken"); };
  EXPECT_THROW(swarm_search(broken, 2, options), ArgumentError);
  EXPECT_THROW(swarm_search(rastrigin, 0, options), ArgumentError);
}

TEST(GeneticSearch, FindsTheLeastOfManyMinimaWithTheSameBitsOnAnyNumberOfThreads) {
  GeneticOptions options;
  options.generations = 150;
  options.stagnation = 60;
  const PopulationResult one = genetic_search(rastrigin, 3, options);
  EXPECT_LT((one.points[0].array() - 0.7).abs().maxCoeff(), 0.1);
  options.threads = 3;
  EXPECT_EQ(genetic_search(rastrigin, 3, options).points[0], one.points[0]);
  EXPECT_LE(one.evaluations, 40 + 38 * 150);
}

}  // namespace particle_swarm_test
}  // namespace placegraph
