#pragma once
#include <placegraph/backend/internal/solver/packed_graph.h>

#include <cstdlib>

namespace placegraph {

/// The odometry of a packed graph laid end to end: what it says of the motion between any two poses
/// of one run, and how surely, in constant time (prefix products and prefix sums).
///
/// Where a node has several odometry edges to a successor, the most informative one is taken. A
/// node without odometry is a run of its own.
template <class Group>
class OdometryChain {
 public:
  using Jacobian = typename Group::Jacobian;

  explicit OdometryChain(const PackedGraph<Group>& graph);

  int runs() const { return runs_; }
  int run(int node) const { return run_[node]; }
  /// Steps from the first node of the run.
  int position(int node) const { return position_[node]; }
  /// T_first_node: the node seen from the first node of its run.
  const Group& pose(int node) const { return pose_[node]; }
  /// Whether the nodes follow each other in one run.
  bool repeats_step(int a, int b) const {
    return run_[a] == run_[b] && std::abs(position_[a] - position_[b]) == 1;
  }
  /// Covariance of all odometry between two nodes of one run as a left perturbation in the
  /// coordinates of the run's first node: T_first_b = Exp(xi) T_first_a T_a_b, to first order
  /// (Barfoot & Furgale 2014, eq. 37 without the second-order terms).
  Jacobian covariance(int a, int b) const;

 private:
  int runs_ = 0;
  std::vector<int> run_, position_;
  std::vector<Group> pose_;
  std::vector<Jacobian, Eigen::aligned_allocator<Jacobian>> sum_;
};

/// Inverse of an information matrix; directions that are known less than 1e-9 times as well as the
/// best known one (or not at all) get the variance of that bound.
template <class Jacobian>
Jacobian covariance_of(const Jacobian& information);

}  // namespace placegraph
