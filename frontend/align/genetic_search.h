#pragma once
#include <placegraph/frontend/align/align_options.h>
#include <placegraph/frontend/align/particle_swarm.h>

namespace placegraph {

/// Minimizes a cost by a real-coded genetic algorithm with as many evaluations as the swarm.
///
/// Tournament selection, blend crossover (Eshelman & Schaffer 1993), normal mutation, elite. The
/// start and the coordinates are those of swarm_search. It serves for comparison with the swarm:
/// nine of ten searches by ZNCC converge from 24 px, those of the swarm from 32 px, in the same
/// time (docs/results/alignment.md).
PopulationResult genetic_search(const PopulationCost& cost, int n, const GeneticOptions& options);

}  // namespace placegraph
