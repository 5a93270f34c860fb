#pragma once
#include <placegraph/eval/edges/truth_noise.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/pose_graph/constraint.h>

#include <map>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// True poses of the nodes of a graph, and their noise.
struct TrueNodes {
  std::map<NodeId, SE3> T_world_node;
  TruthNoise noise;
  /// The nodes' frames in the trajectory whose noise it is; a node without one has white noise.
  std::map<NodeId, int> frames;
  /// Parameters that were fitted to the odometry edges, as by fit_mount().
  double fitted = 0;

  /// Whether the pose of a node was interpolated, not measured.
  bool is_interpolated(NodeId node) const;
  /// Covariance of the noise of the true relative pose, in the right tangent.
  Matrix6d covariance(NodeId from, NodeId to) const;
};

/// The quantities of an edge of which the error is tested.
const std::vector<std::string>& edge_axes(PoseKind kind);

/// Whether the error of an edge can be judged.
enum class EdgeState {
  kJudged,        ///< yes
  kUnknown,       ///< no: an end has no true pose, or a similarity no true scale
  kInterpolated,  ///< no: the true pose of an end was not measured
};

/// The error of an edge, in those quantities of edge_axes() that can be tested.
struct EdgeError {
  EdgeState state = EdgeState::kUnknown;
  std::vector<int> axes;     ///< their numbers in edge_axes()
  Eigen::VectorXd error;     ///< against the true relative pose
  Eigen::MatrixXd stated;    ///< covariance that the edge states
  Eigen::MatrixXd of_truth;  ///< covariance of the noise of the true relative pose
};

/// The errors of the edges of a graph, in their order.
///
/// Over SE(3): Log(T_from_to^-1 T_true). Over Sim(3) each node has a scale of its own: the ratio of
/// true to measured length of the first odometry edge that begins there. Of that edge then
/// direction, rotation, and the change of scale up to its end are tested; of other edges their
/// length, too. The variances of the lengths from which scales come are added where the scales are
/// used. Edges shorter than a thousandth of the median have no direction and are not judged. Throws
/// ArgumentError for edges in the plane and of several kinds.
std::vector<EdgeError> edge_errors(const std::vector<RelativePoseConstraint>& edges,
                                   const TrueNodes& truth);

}  // namespace placegraph
