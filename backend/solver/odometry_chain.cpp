#include <placegraph/backend/solver/odometry_chain.h>

#include <Eigen/Eigenvalues>
#include <tuple>

namespace placegraph {
namespace {

using Successors = std::vector<int>;  // edge to the next node; -1: none

/// A total order of the edges between the same nodes that is independent of their positions.
template <class Edge>
bool more_informative(const Edge& a, const Edge& b) {
  const double trace_a = a.information.trace(), trace_b = b.information.trace();
  if (trace_a != trace_b) return trace_a > trace_b;
  const auto log_a = a.T_to_from.log(), log_b = b.T_to_from.log();
  return std::lexicographical_compare(log_a.begin(), log_a.end(), log_b.begin(), log_b.end());
}

/// At most one successor and one predecessor for every node.
template <class Group>
Successors successors(const PackedGraph<Group>& graph) {
  const auto precedes = [&](int a, int b) {
    const auto &edge_a = graph.edges[a], &edge_b = graph.edges[b];
    if (std::tie(edge_a.from, edge_a.to) != std::tie(edge_b.from, edge_b.to))
      return std::tie(edge_a.from, edge_a.to) < std::tie(edge_b.from, edge_b.to);
    return more_informative(edge_a, edge_b);
  };
  std::vector<int> order;
  for (std::size_t i = 0; i < graph.edges.size(); ++i)
    if (graph.edges[i].odometry) order.push_back(static_cast<int>(i));
  std::sort(order.begin(), order.end(), precedes);
  Successors next(graph.poses.size(), -1);
  std::vector<char> has_predecessor(graph.poses.size(), false);
  for (const int edge : order) {
    const auto& e = graph.edges[edge];
    if (next[e.from] >= 0 || has_predecessor[e.to]) continue;
    next[e.from] = edge;
    has_predecessor[e.to] = true;
  }
  return next;
}

}  // namespace

template <class Jacobian>
Jacobian covariance_of(const Jacobian& information) {
  // Keeps the inverse finite. Chosen.
  constexpr double kLeast = 1e-9;
  Eigen::SelfAdjointEigenSolver<Jacobian> eigen(information);
  const double floor = kLeast * eigen.eigenvalues().maxCoeff();
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(floor).cwiseInverse().asDiagonal() *
         eigen.eigenvectors().transpose();
}

template <class Group>
OdometryChain<Group>::OdometryChain(const PackedGraph<Group>& graph)
    : run_(graph.poses.size(), -1), position_(graph.poses.size(), 0), pose_(graph.poses.size()) {
  const Successors next = successors(graph);
  sum_.assign(graph.poses.size(), Jacobian::Zero());
  std::vector<char> first(graph.poses.size(), true);
  for (const int edge : next)
    if (edge >= 0) first[graph.edges[edge].to] = false;
  const auto walk = [&](int start) {
    run_[start] = runs_;
    for (int node = start; next[node] >= 0;) {
      const auto& edge = graph.edges[next[node]];
      if (run_[edge.to] >= 0) break;  // a ring of odometry
      pose_[edge.to] = pose_[node] * edge.T_to_from.inverse();
      const Jacobian adjoint = pose_[edge.to].adjoint();
      sum_[edge.to] = sum_[node];
      sum_[edge.to].noalias() += adjoint * covariance_of(edge.information) * adjoint.transpose();
      run_[edge.to] = runs_;
      position_[edge.to] = position_[node] + 1;
      node = edge.to;
    }
    ++runs_;
  };
  const int n = static_cast<int>(graph.poses.size());
  for (int node = 0; node < n; ++node)
    if (first[node]) walk(node);
  for (int node = 0; node < n; ++node)
    if (run_[node] < 0) walk(node);
}

template class OdometryChain<SE2>;
template class OdometryChain<SE3>;
template class OdometryChain<Sim3>;
template Eigen::Matrix3d covariance_of(const Eigen::Matrix3d&);
template SE3::Jacobian covariance_of(const SE3::Jacobian&);
template Sim3::Jacobian covariance_of(const Sim3::Jacobian&);

}  // namespace placegraph
