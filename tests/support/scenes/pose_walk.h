#pragma once
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <cmath>
#include <numbers>

#include "tests/support/scenes/poses.h"

namespace placegraph::test {

template <class Group>
Group random_element(Random& random, double sigma, double sigma_rad) {
  typename Group::Tangent xi;
  constexpr int dim = Group::kDof == 3 ? 2 : 3;
  for (int i = 0; i < Group::kDof; ++i) xi[i] = random.normal() * (i < dim ? sigma : sigma_rad);
  if (Group::kDof == 7) xi[Group::kDof - 1] *= 0.2;
  return Group::exp(xi);
}

template <class Group>
Information isotropic(double weight) {
  return Information(Information::Identity(Group::kDof, Group::kDof) * weight);
}

template <class Group>
RelativePoseConstraint constraint(std::int64_t from, std::int64_t to, const Group& T_from_to,
                                  double weight = 100) {
  RelativePoseConstraint c;
  c.from = NodeId(from);
  c.to = NodeId(to);
  c.T_from_to = T_from_to;
  c.information = isotropic<Group>(weight);
  c.source = to == from + 1 ? ConstraintSource::kOdometry : ConstraintSource::kLoop;
  return c;
}

/// A closed walk of `n` nodes with chords; ids 10, 11, ...; measurements disturbed by `noise` (m
/// and rad), the start by drift.
template <class Group>
struct Walk {
  explicit Walk(int n, double noise, std::uint64_t seed = 1) {
    Random random(seed);
    typename Group::Tangent step = Group::Tangent::Zero();
    step[0] = 1;
    step[Group::kDof == 3 ? 2 : 5] = 2 * std::numbers::pi / n;
    for (int i = 0; i < n; ++i)
      truth.push_back(i == 0 ? Group()
                             : truth.back() * Group::exp(step) *
                                   random_element<Group>(random, 0.1, 0.1));
    const auto measure = [&](int from, int to) {
      const Group T_from_to =
          truth[from].inverse() * truth[to] * random_element<Group>(random, noise, noise);
      graph.constraints.emplace_back(constraint<Group>(10 + from, 10 + to, T_from_to));
    };
    for (int i = 0; i < n; ++i) {
      graph.nodes.push_back({NodeId(10 + i), truth[i], false});
      if (i > 0) measure(i - 1, i);
      if (i >= 5 && i % 2 == 0) measure(i - 5, i);
    }
    measure(0, n - 1);
    for (int i = 1; i < n; ++i)
      graph.nodes[i].T_world_node = truth[i] * random_element<Group>(random, 0.1, 0.05);
  }
  const Group& pose(const PoseGraph& g, int i) const {
    return std::get<Group>(g.nodes[i].T_world_node);
  }
  std::vector<Group> truth;
  PoseGraph graph;
};

}  // namespace placegraph::test
