#pragma once
#include <placegraph/backend/solver/packed_graph.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "tests/support/scenes/pose_walk.h"

namespace placegraph::test {

/// Positive definite with random axes; no eigenvalue is below one.
inline Eigen::MatrixXd random_information(Eigen::Index size, Random& random) {
  Eigen::MatrixXd J(size, size);
  for (Eigen::Index i = 0; i < J.size(); ++i) J.data()[i] = random.normal();
  return J.transpose() * J + Eigen::MatrixXd::Identity(size, size);
}
template <class Matrix>
Matrix random_information(Random& random) {
  return random_information(Matrix::RowsAtCompileTime, random);
}

template <class T>
void shuffle(std::vector<T>& values, Random& random) {
  for (int i = static_cast<int>(values.size()); i > 1; --i)
    std::swap(values[i - 1], values[random.index(i)]);
}

/// The closed walk of pose_walk.h, every edge with an information of its own.
template <class Group>
PackedGraph<Group> packed_walk(int nodes, double noise, std::uint64_t seed) {
  const Walk<Group> walk(nodes, noise, seed);
  PackedGraph<Group> graph = pack<Group>(walk.graph);
  Random random(seed, 1);
  for (auto& edge : graph.edges)
    edge.information = 50 * random_information<typename Group::Jacobian>(random);
  return graph;
}

/// How far apart two sets of poses are: the longest tangent from one to the other.
template <class Group>
double distance(const std::vector<Group>& a, const std::vector<Group>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most = std::max(most, (a[i].inverse() * b[i]).log().norm());
  return most;
}

}  // namespace placegraph::test
