#include <placegraph/backend/incremental/incremental_optimizer.h>
#include <placegraph/backend/initialization/incremental_initialization.h>
#include <placegraph/backend/solver/odometry_chain.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

namespace placegraph {
namespace {

// Parts between which the graph is optimized: the cost. Chosen.
constexpr std::size_t kParts = 100;

/// The nodes in the order of the odometry, run by run; without odometry in their own order.
template <class Group>
std::vector<int> order_of_extension(const PackedGraph<Group>& graph) {
  const OdometryChain<Group> odometry(graph);
  std::vector<int> order(graph.poses.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return odometry.place(a) < odometry.place(b); });
  return order;
}

/// The constraints of the graph with their weights, by the later of their nodes in the order.
/// Positions in that order are the ids.
template <class Group>
std::vector<std::vector<Constraint>> constraints_by_step(const PackedGraph<Group>& graph,
                                                         const std::vector<int>& order) {
  std::vector<int> step(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) step[order[k]] = static_cast<int>(k);
  std::vector<std::vector<Constraint>> constraints(order.size());
  const auto add = [&](int at, auto constraint, double weight) {
    if (weight == 0) return;
    // weight rho(s; width) = rho(weight s; sqrt(weight) width) for every kernel.
    constraint.information *= weight;
    constraint.kernel.width *= std::sqrt(weight);
    constraints[at].push_back(std::move(constraint));
  };
  for (const auto& edge : graph.edges) {
    RelativePoseConstraint relative;
    relative.from = NodeId(step[edge.from]);
    relative.to = NodeId(step[edge.to]);
    relative.T_from_to = edge.T_to_from.inverse();
    relative.information = edge.information;
    relative.source = edge.odometry ? ConstraintSource::kOdometry : ConstraintSource::kLoop;
    relative.kernel = edge.kernel;
    add(std::max(step[edge.from], step[edge.to]), std::move(relative), edge.weight);
  }
  for (const auto& position : graph.positions)
    add(step[position.node],
        PositionConstraint{NodeId(step[position.node]), position.position_world, position.lever_arm,
                           position.information, position.kernel},
        position.weight);
  return constraints;
}

}  // namespace

template <class Group>
bool initialize_incrementally(PackedGraph<Group>& graph, RotationError rotation_error,
                              double most_factorizations) {
  const std::size_t nodes = graph.poses.size();
  const std::size_t part = (nodes + kParts - 1) / kParts;
  const std::vector<char>& held = graph.components.held;
  const std::vector<int> order = order_of_extension(graph);
  auto constraints = constraints_by_step(graph, order);
  IncrementalOptimizer optimizer({.rotation_error = rotation_error});
  double eliminated = 0;
  for (std::size_t first = 0; first < nodes; first += part) {
    GraphChange change;
    const std::size_t end = std::min(nodes, first + part);
    for (std::size_t k = first; k < end; ++k) {
      change.nodes.push_back({NodeId(k), graph.poses[order[k]], held[order[k]] != 0});
      std::move(constraints[k].begin(), constraints[k].end(),
                std::back_inserter(change.constraints));
    }
    const IncrementalStep step = optimizer.apply(change);
    eliminated += step.nodes_refactored;
    if (step.solved_from_scratch) eliminated += step.iterations * static_cast<double>(end);
    if (!std::isfinite(step.cost) || eliminated > most_factorizations * static_cast<double>(nodes))
      return false;
  }
  for (std::size_t k = 0; k < nodes; ++k)
    if (!held[order[k]]) graph.poses[order[k]] = std::get<Group>(*optimizer.pose(NodeId(k)));
  return true;
}

template bool initialize_incrementally(PackedGraph<SE2>&, RotationError, double);
template bool initialize_incrementally(PackedGraph<SE3>&, RotationError, double);
template bool initialize_incrementally(PackedGraph<Sim3>&, RotationError, double);

}  // namespace placegraph
