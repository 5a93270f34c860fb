#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A measured pose of a node, as by motion capture:
/// error = Log(T_world_node_measured^-1 * T_world_node).
struct PosePriorConstraint {
  NodeId node;              ///< the node
  Pose T_world_node;        ///< measured pose, of the kind of the nodes
  Information information;  ///< information of the error, in the right tangent
  /// Whether the sensor has an offset to the node, so that its measurement was converted to the
  /// node: exact for RotationError::kLog, not for kQuaternion.
  bool beside_node = false;
};

/// A point landmark; in the plane its z coordinate is 0 and stays so.
struct GraphPoint {
  NodeId id;                                                 ///< unique among points and nodes
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();  ///< estimated position
  bool fixed = false;  ///< optimization leaves the point unchanged
};

/// The observation of a point from a node:
/// error = T_world_node^-1 * position_world - position_node. In the plane the third components are
/// ignored.
struct PointObservation {
  NodeId node, point;  ///< ids of the node and the point
  /// Measured position in the node's frame.
  Eigen::Vector3d position_node = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();  ///< information of the error
};

/// A pose graph with measured poses and point landmarks, over SE(2) or SE(3).
struct LandmarkGraph {
  PoseGraph poses;                             ///< nodes and constraints between them
  std::vector<PosePriorConstraint> priors;     ///< measured poses of nodes
  std::vector<GraphPoint> points;              ///< landmarks
  std::vector<PointObservation> observations;  ///< observations of landmarks from nodes

  /// Whether the graph has no priors, points or observations.
  bool has_poses_alone() const { return priors.empty() && points.empty() && observations.empty(); }
  /// Throws ArgumentError naming the first entry that is invalid.
  /// Invalid are entries that PoseGraph::check refuses and, in priors, points and observations,
  /// unknown nodes and points, duplicate ids, values that are not finite, information that is
  /// indefinite or all zero, and a graph of similarities.
  void check() const;
};

}  // namespace placegraph
