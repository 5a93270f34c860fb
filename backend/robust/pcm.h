#pragma once
#include <placegraph/backend/robust/loop_pairs.h>

#include <cstdint>

namespace placegraph {

/// Pairwise consistency maximization (Mangelsdorf et al. 2018).
/// "Pairwise consistent measurement set maximization for robust multi-robot map merging": two loops
/// are consistent if the ring they close with the odometry between their ends has a squared error
/// of at most `gate`, weighted by the information. For the loops between two runs (or within one)
/// the largest set of pairwise consistent loops is returned. Sets are positions in
/// PackedGraph::edges, the largest set first; every loop is compared with every other one between
/// the same runs. `max_steps` limits the search (max_clique.h).
template <class Group>
std::vector<std::vector<int>> consistent_loops(const PackedGraph<Group>& graph,
                                               const OdometryChain<Group>& chain, double gate,
                                               std::int64_t max_steps = 20000000);

}  // namespace placegraph
