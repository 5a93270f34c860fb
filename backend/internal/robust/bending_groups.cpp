#include <placegraph/backend/internal/robust/bending_groups.h>
#include <placegraph/graph/internal/core/disjoint_sets.h>

#include <algorithm>
#include <utility>

namespace placegraph {
namespace {

using Loops = std::vector<int>;  // positions in PackedGraph::edges

constexpr double kDrift = 10;       ///< ratio of the noise of long rings to that of short ones
constexpr std::size_t kTried = 10;  ///< groups that are left out in turn

template <class Group>
std::vector<double> weighted_errors(const PackedGraph<Group>& graph, RotationError rotation_error) {
  std::vector<double> errors = chi2_by_edge(graph, rotation_error);
  for (std::size_t i = 0; i < errors.size(); ++i) errors[i] *= graph.edges[i].weight;
  return errors;
}

double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

/// The number of parts that the edges with weight leave unconnected with each other.
template <class Group>
std::size_t parts_of(const PackedGraph<Group>& graph) {
  DisjointSets sets(graph.poses.size());
  std::size_t parts = graph.poses.size();
  for (const auto& edge : graph.edges) {
    if (edge.weight == 0 || sets.root(edge.from) == sets.root(edge.to)) continue;
    sets.join(edge.from, edge.to);
    --parts;
  }
  return parts;
}

/// Whether the cost is far above the noise of the rings.
template <class Group>
bool is_bent(const PackedGraph<Group>& graph, double cost, double noise_scale) {
  const auto edges = std::count_if(graph.edges.begin(), graph.edges.end(),
                                   [](const auto& edge) { return edge.weight > 0; });
  const double redundant = static_cast<double>(edges) - static_cast<double>(graph.poses.size()) + 1;
  return cost > kDrift * noise_scale * Group::kDof * std::max(1.0, redundant);
}

/// The loops with weight of every group that has some, those of the largest mean error first.
template <class Group>
std::vector<Loops> by_strain(const PackedGraph<Group>& graph, const std::vector<Loops>& groups,
                             const std::vector<double>& errors) {
  std::vector<std::pair<double, Loops>> strained;
  for (const Loops& group : groups) {
    Loops kept;
    double error = 0;
    for (const int edge : group) {
      if (graph.edges[edge].weight == 0) continue;
      kept.push_back(edge);
      error += errors[edge];
    }
    if (!kept.empty()) strained.emplace_back(-error / static_cast<double>(kept.size()), kept);
  }
  std::sort(strained.begin(), strained.end());
  std::vector<Loops> result;
  for (auto& [strain, kept] : strained) result.push_back(std::move(kept));
  return result;
}

}  // namespace

template <class Group>
bool drop_bending_group(PackedGraph<Group>& graph, const std::vector<std::vector<int>>& groups,
                        const RingNoise& noise, RotationError rotation_error,
                        SubsetSolver<Group>& solver) {
  const std::vector<double> errors = weighted_errors(graph, rotation_error);
  const double before = sum(errors);
  if (!is_bent(graph, before, noise.scale)) return false;
  const PackedGraph<Group> bent = graph;
  const std::size_t parts = parts_of(graph);
  std::vector<Loops> strained = by_strain(graph, groups, errors);
  if (strained.size() > kTried) strained.resize(kTried);
  for (const Loops& group : strained) {
    for (const int edge : group) graph.edges[edge].weight = 0;
    if (parts_of(graph) == parts) {
      (void)solver.solve(graph);
      const double explained = kDrift * static_cast<double>(group.size()) * noise.gate;
      if (before - sum(weighted_errors(graph, rotation_error)) > explained) return true;
    }
    graph = bent;
  }
  return false;
}

template bool drop_bending_group(PackedGraph<SE2>&, const std::vector<std::vector<int>>&,
                                 const RingNoise&, RotationError, SubsetSolver<SE2>&);
template bool drop_bending_group(PackedGraph<SE3>&, const std::vector<std::vector<int>>&,
                                 const RingNoise&, RotationError, SubsetSolver<SE3>&);
template bool drop_bending_group(PackedGraph<Sim3>&, const std::vector<std::vector<int>>&,
                                 const RingNoise&, RotationError, SubsetSolver<Sim3>&);

}  // namespace placegraph
