#pragma once
#include <placegraph/frontend/align/particle_swarm.h>

namespace placegraph {

/// Options of the genetic search.
struct GeneticOptions {
  int members = 40;             ///< size of the population
  int generations = 40;         ///< maximum number of generations
  int stagnation = 12;          ///< generations without a better best member that end the search
  int tournament = 3;           ///< members drawn for each parent; the best becomes the parent
  int elite = 2;                ///< best members kept unchanged
  double blend = 0.3;           ///< share by which the box of children exceeds that of the parents
  double mutation_rate = 0.2;   ///< probability that a coordinate mutates
  double mutation_sigma = 0.3;  ///< initial, in standard deviations of the start; decreases to
  ///< a tenth of that over the search
  double bound = 3;  ///< largest absolute value of a coordinate [standard deviations of the start]
  std::uint64_t seed = 1;  ///< seed of the random stream
  int threads = 1;         ///< the result does not depend on it
  void check() const;
};
void visit(OptionVisitor& field, GeneticOptions& options);

/// Minimizes a cost by a real-coded genetic algorithm with as many evaluations as the swarm.
///
/// Tournament selection, blend crossover (Eshelman & Schaffer 1993), normal mutation, elite. The
/// start and the coordinates are those of swarm_search. It serves for comparison with the swarm:
/// nine of ten searches by ZNCC converge from 24 px, those of the swarm from 32 px, in the same
/// time (docs/results/alignment.md).
PopulationResult genetic_search(const PopulationCost& cost, int n, const GeneticOptions& options);

}  // namespace placegraph
