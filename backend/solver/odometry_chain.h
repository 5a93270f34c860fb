#pragma once
#include <placegraph/backend/solver/packed_graph.h>

#include <cstdlib>
#include <utility>

namespace placegraph {

/// The concatenated odometry of a packed graph.
/// It computes the motion between any two poses of one run and its covariance in constant time
/// (prefix products and prefix sums).
///
/// If a node has several odometry edges to a successor, the most informative one is used. A node
/// without odometry is a run of its own.
template <class Group>
class OdometryChain {
 public:
  using Jacobian = typename Group::Jacobian;

  explicit OdometryChain(const PackedGraph<Group>& graph);

  int runs() const { return runs_; }
  int run(int node) const { return run_[node]; }
  /// Steps from the first node of the run.
  int position(int node) const { return position_[node]; }
  /// Its run and position in it.
  std::pair<int, int> place(int node) const { return {run_[node], position_[node]}; }
  /// T_first_node: pose of the node relative to the first node of its run.
  const Group& pose(int node) const { return pose_[node]; }
  /// Whether the nodes are successive in one run.
  bool repeats_step(int a, int b) const {
    return run_[a] == run_[b] && std::abs(position_[a] - position_[b]) == 1;
  }
  /// Covariance of all odometry between two nodes of one run as a left perturbation in the
  /// coordinates of the run's first node: T_first_b = Exp(xi) T_first_a T_a_b, to first order
  /// (Barfoot & Furgale 2014, eq. 37 without the second-order terms).
  Jacobian covariance(int a, int b) const {
    return position_[a] > position_[b] ? sum_[a] - sum_[b] : sum_[b] - sum_[a];
  }

 private:
  int runs_ = 0;
  std::vector<int> run_, position_;
  std::vector<Group> pose_;
  std::vector<Jacobian, Eigen::aligned_allocator<Jacobian>> sum_;
};

/// Inverse of an information matrix; the information of every direction is at least 1e-9 times that
/// of the best determined one.
template <class Jacobian>
Jacobian covariance_of(const Jacobian& information);

}  // namespace placegraph
