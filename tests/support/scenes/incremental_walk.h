#pragma once
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <cmath>
#include <numbers>

namespace placegraph::test {

template <class Group>
Group random_group_element(Random& random, double sigma_m, double sigma_rad) {
  typename Group::Tangent xi;
  constexpr int dim = Group::kDof == 3 ? 2 : 3;
  for (int i = 0; i < Group::kDof; ++i) xi[i] = random.normal() * (i < dim ? sigma_m : sigma_rad);
  if (Group::kDof == 7) xi[6] *= 0.2;
  return Group::exp(xi);
}

/// Rounds on a circle of `round` nodes, 1 m apart: odometry, and to about a third of the nodes
/// loops to the round before. Ids 10, 11, ...; measurements disturbed by `noise` (m and rad); the
/// poses given are of no use.
template <class Group>
struct IncrementalWalk {
  IncrementalWalk(int n, double noise, std::uint64_t seed, int round = 15) : random(seed) {
    typename Group::Tangent step = Group::Tangent::Zero();
    step[0] = 1;
    step[Group::kDof == 3 ? 2 : 5] = 2 * std::numbers::pi / round;
    for (int i = 0; i < n; ++i) {
      truth.push_back(i == 0 ? Group()
                             : truth.back() * Group::exp(step) *
                                   random_group_element<Group>(random, 0.1, 0.1));
      graph.nodes.push_back(
          {NodeId(10 + i), i == 0 ? Group() : random_group_element<Group>(random, 5, 1), false});
      if (i > 0) graph.constraints.emplace_back(measure(i - 1, i, noise));
      for (const int back : {round, round - 2})
        if (i > back && random.uniform() < 0.2)
          graph.constraints.emplace_back(measure(i - back, i, noise));
    }
  }
  RelativePoseConstraint measure(int from, int to, double noise) {
    RelativePoseConstraint c;
    c.from = NodeId(10 + from);
    c.to = NodeId(10 + to);
    c.T_from_to =
        truth[from].inverse() * truth[to] * random_group_element<Group>(random, noise, noise);
    c.information = Information(Information::Identity(Group::kDof, Group::kDof) * 100);
    c.source = to == from + 1 ? ConstraintSource::kOdometry : ConstraintSource::kLoop;
    return c;
  }
  Random random;
  std::vector<Group> truth;
  PoseGraph graph;
};

}  // namespace placegraph::test
