#pragma once
#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <memory>

namespace placegraph {

/// How well a pose graph knows its poses: covariances of the normal equations' Gaussian at the
/// graph's poses (which ought to be its optimum), in the right tangents T_world_node exp(xi), held
/// nodes without uncertainty (those of the optimizer: fixed ones, else the first of a component).
/// Robust kernels count with their weight at these poses. One factorization in the constructor;
/// nothing is ever inverted densely.
class PoseMarginals {
 public:
  /// Throws as PoseGraph::check.
  explicit PoseMarginals(const PoseGraph& graph,
                         RotationError rotation_error = RotationError::kLog);
  ~PoseMarginals();
  PoseMarginals(PoseMarginals&&) noexcept;
  PoseMarginals& operator=(PoseMarginals&&) noexcept;

  /// kDegenerate: the constraints leave directions open; then no covariance may be asked for.
  const Outcome& outcome() const;

  /// Covariance of one pose, dof x dof.
  Information covariance(NodeId id) const;
  /// Of several poses jointly, in the order of `ids`: by one solve for every column of theirs.
  Eigen::MatrixXd joint_covariance(const std::vector<NodeId>& ids) const;
  /// Of the relative pose T_from_to in its own right tangent.
  Information relative_covariance(NodeId from, NodeId to) const;
  /// Of the relative pose that every relative-pose constraint speaks of, as the graph now knows it,
  /// in the order of the constraints (empty for other constraints): all at once from the sparse
  /// inverse subset.
  std::vector<Information> constraint_covariances() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace placegraph
