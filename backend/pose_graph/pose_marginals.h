#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/pose_graph/landmark_graph.h>

#include <memory>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Covariances of the poses of an optimized pose graph, and of a landmark graph's points.
/// They are those of the Gaussian of the normal equations at the graph's poses (which should be the
/// optimum), in the right tangents T_world_node exp(xi). Held nodes (as in the optimizer: fixed
/// ones, else the first of a component) have no uncertainty. Robust kernels enter by their weights
/// at these poses. The constructor makes one factorization; no dense inverse is computed.
class PoseMarginals {
 public:
  /// Throws as PoseGraph::check.
  explicit PoseMarginals(const PoseGraph& graph,
                         RotationError rotation_error = RotationError::kLog);
  /// The same of a graph with priors and points, whose covariances are in the axes of the world.
  ///
  /// Throws as LandmarkGraph::check.
  explicit PoseMarginals(const LandmarkGraph& graph,
                         RotationError rotation_error = RotationError::kLog);
  ~PoseMarginals();
  PoseMarginals(PoseMarginals&&) noexcept;
  PoseMarginals& operator=(PoseMarginals&&) noexcept;

  /// Says whether there are covariances.
  ///
  /// kDegenerate: the constraints leave directions of the nodes and points that the reason names
  /// undetermined; no covariance may be requested then.
  const Outcome& outcome() const;

  /// Covariance of one pose, dof x dof, or of a point: 3 x 3, in the plane 2 x 2.
  Information covariance(NodeId id) const;
  /// Covariances of all poses, in the order of the graph's nodes.
  ///
  /// They are computed together from the sparse inverse subset, at the cost of a second
  /// factorization.
  std::vector<Information> covariances() const;
  /// The same of all points, in the order of LandmarkGraph::points.
  std::vector<Information> point_covariances() const;
  /// Joint covariance of several poses and points, in the order of `ids`; one solve for every
  /// column.
  Eigen::MatrixXd joint_covariance(const std::vector<NodeId>& ids) const;
  /// Covariance of the relative pose T_from_to in its own right tangent.
  ///
  /// Throws ArgumentError for nodes of different components: no constraints connect them.
  Information relative_covariance(NodeId from, NodeId to) const;
  /// Covariances in the graph of the relative poses of all relative-pose constraints.
  ///
  /// They are in the order of the constraints, empty for other constraints, and computed together
  /// from the sparse inverse subset.
  std::vector<Information> constraint_covariances() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace placegraph
