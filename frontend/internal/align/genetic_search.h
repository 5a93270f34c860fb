#pragma once
#include <placegraph/frontend/internal/align/particle_swarm.h>

namespace placegraph {

struct GeneticOptions {
  int members = 40;
  int generations = 40;
  int stagnation = 12;          ///< generations without a better best member that end the search
  int tournament = 3;           ///< members drawn, the best of whom becomes a parent
  int elite = 2;                ///< best members that live on unchanged
  double blend = 0.3;           ///< children lie in the box of the parents, larger by this share
  double mutation_rate = 0.2;   ///< of a coordinate
  double mutation_sigma = 0.3;  ///< at the beginning, in standard deviations of the start; falls
                                ///< to a tenth of it over the run
  double bound = 3;             ///< coordinates stay within, in the same unit
  std::uint64_t seed = 1;
  int threads = 1;  ///< the result does not depend on it
  void check() const;
};
void visit(OptionVisitor& field, GeneticOptions& options);

/// A real-coded genetic algorithm with as many evaluations as the swarm, to compare with it:
/// tournament selection, blend crossover (Eshelman & Schaffer 1993), normal mutation, elite. The
/// start and the coordinates are those of swarm_search. Nine of ten searches by ZNCC converge from
/// 24 px, those of the swarm from 32 px, in the same time (docs/results.md, section alignment).
PopulationResult genetic_search(const PopulationCost& cost, int n, const GeneticOptions& options);

}  // namespace placegraph
