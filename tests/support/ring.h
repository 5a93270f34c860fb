#pragma once
#include <numbers>

#include "tests/support/scenes/pose_walk.h"

namespace placegraph::test {

/// A closed ring of `n` nodes, every one turned by 2 pi / n against the one before, with exact
/// measurements; steps so short that rotations decide. With `wound` the start turns once more on
/// the way round than was measured, which is a local minimum: every edge is off by 2 pi / n.
template <class Group>
PoseGraph ring(int n, bool wound, double step_m = 0.01) {
  typename Group::Tangent step = Group::Tangent::Zero(), rotation = Group::Tangent::Zero();
  constexpr int yaw = Group::kDof == 3 ? 2 : 5;
  step[0] = step_m;
  step[yaw] = 2 * std::numbers::pi / n;
  rotation[yaw] = 2 * std::numbers::pi / n;
  PoseGraph graph;
  Group T_world_node;
  for (int i = 0; i < n; ++i) {
    graph.nodes.push_back({NodeId(10 + i), T_world_node, false});
    T_world_node = T_world_node * Group::exp(step);
    if (wound) T_world_node = T_world_node * Group::exp(rotation);
    graph.constraints.emplace_back(
        constraint<Group>(10 + i, 10 + (i + 1) % n, Group::exp(step), 100));
  }
  return graph;
}

}  // namespace placegraph::test
