#pragma once
#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/graph/core/options.h>

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

namespace placegraph {

/// Value of a point of R^n that a population search makes small. It is called from several threads
/// at once, so it must not change anything.
using PopulationCost = std::function<double(const Eigen::VectorXd&)>;

/// What a population search found: the members' best points so far, best first.
struct PopulationResult {
  std::vector<Eigen::VectorXd> points;
  std::vector<double> costs;  ///< as many, ascending
  int generations = 0, evaluations = 0;
};

/// Costs of the points, each into its own place, by `threads` threads.
void evaluate_population(const PopulationCost& cost, const std::vector<Eigen::VectorXd>& points,
                         int threads, std::vector<double>& costs);

/// Points and costs in ascending order of cost; of equal ones in the order of their indices.
void sort_population(PopulationResult& population);

/// chi for phi > 4: 0.7298 for 4.1.
double constriction(double phi);

/// Particle swarm search (Kennedy & Eberhart 1995) in n dimensions. Coordinates are in standard
/// deviations: the first particle starts at the origin, all others normally distributed about it.
/// Every particle draws from a random stream of its own and the bests are compared in the order of
/// indices once a generation is complete, so that the same bits come from any number of threads.
PopulationResult swarm_search(const PopulationCost& cost, int n, const SwarmOptions& options);

}  // namespace placegraph
