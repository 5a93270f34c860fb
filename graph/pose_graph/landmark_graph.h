#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A measured pose of a node, as by motion capture:
/// error = Log(T_world_node_measured^-1 * T_world_node).
struct PosePriorConstraint {
  NodeId node;              ///< the node
  Pose T_world_node;        ///< measured; of the kind of the nodes
  Information information;  ///< of the error, in the right tangent
  /// Whether the sensor that measured it has an offset to the node, so that the measurement was
  /// converted to the node: exact for RotationError::kLog, not for kQuaternion.
  bool beside_node = false;
};

/// A point landmark; in the plane its z coordinate is 0 and stays so.
struct GraphPoint {
  NodeId id;                                                 ///< unique among points and nodes
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();  ///< the estimate
  bool fixed = false;                                        ///< stays where it is
};

/// The observation of a point from a node:
/// error = T_world_node^-1 * position_world - position_node. In the plane the third components are
/// left out.
struct PointObservation {
  NodeId node, point;                                         ///< ids of the two
  Eigen::Vector3d position_node = Eigen::Vector3d::Zero();    ///< measured, in the node's frame
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();  ///< of the error
};

/// A pose graph with measured poses and point landmarks, over SE(2) or SE(3).
struct LandmarkGraph {
  PoseGraph poses;                             ///< nodes and constraints between them
  std::vector<PosePriorConstraint> priors;     ///< measured poses of nodes
  std::vector<GraphPoint> points;              ///< landmarks
  std::vector<PointObservation> observations;  ///< observations of landmarks from nodes

  /// Whether it is a pose graph and no more.
  bool has_poses_alone() const { return priors.empty() && points.empty() && observations.empty(); }
  /// Throws ArgumentError naming the first entry that is invalid.
  /// Invalid is what PoseGraph::check refuses, and for priors, points and observations: unknown
  /// nodes and points, an id that is there twice, values that are not finite, information that is
  /// indefinite or all zero, a graph of similarities.
  void check() const;
};

}  // namespace placegraph
