#pragma once
#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/graph/core/options.h>

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

namespace placegraph {

/// Cost of a point of R^n that a population search minimizes.
///
/// It is called from several threads at once, so it must have no side effects.
using PopulationCost = std::function<double(const Eigen::VectorXd&)>;

/// Result of a population search: the members' best points, best first.
struct PopulationResult {
  std::vector<Eigen::VectorXd> points;
  std::vector<double> costs;  ///< costs of `points`, ascending
  int generations = 0, evaluations = 0;
};

/// Computes the costs of the points by `threads` threads; costs[i] is that of points[i].
void evaluate_population(const PopulationCost& cost, const std::vector<Eigen::VectorXd>& points,
                         int threads, std::vector<double>& costs);

/// Sorts points and costs by ascending cost, equal ones by their indices.
void sort_population(PopulationResult& population);

/// Constriction factor chi for phi > 4: 0.7298 for 4.1.
double constriction(double phi);

/// Minimizes a cost in n dimensions by a particle swarm (Kennedy & Eberhart 1995).
///
/// Coordinates are in standard deviations: the first particle starts at the origin, all others are
/// normally distributed about it. Every particle has a random stream of its own and the best points
/// are compared in the order of indices once a generation is complete, so that the result is the
/// same to the bit with any number of threads.
PopulationResult swarm_search(const PopulationCost& cost, int n, const SwarmOptions& options);

}  // namespace placegraph
