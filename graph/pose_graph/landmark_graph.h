#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A measured pose of a node, as by motion capture: error = Log(T_world_node_measured^-1 *
/// T_world_node).
struct PosePriorConstraint {
  NodeId node;
  Pose T_world_node;  ///< measured
  Information information;
  /// It was measured by a sensor that stands beside the node, and rewritten for the node: exact in
  /// the logarithm, not in g2o's own error.
  bool beside_node = false;
};

/// A point of the world that nodes see; in the plane z is 0 and stays so.
struct GraphPoint {
  NodeId id;  ///< no pose has it
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();
  bool fixed = false;
};

/// A point as a node sees it: error = T_world_node^-1 * position_world - position_node. In the
/// plane the third components are left out.
struct PointSight {
  NodeId node, point;
  Eigen::Vector3d position_node = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
};

/// A pose graph with measured poses and point landmarks beside it. SE(2) and SE(3).
struct LandmarkGraph {
  PoseGraph poses;
  std::vector<PosePriorConstraint> priors;
  std::vector<GraphPoint> points;
  std::vector<PointSight> sights;

  /// Whether it is a pose graph and no more.
  bool has_poses_alone() const { return priors.empty() && points.empty() && sights.empty(); }
  /// Throws ArgumentError as PoseGraph::check, and for priors, points and sights: unknown nodes and
  /// points, an id that is there twice, values that are not finite, information that is indefinite
  /// or all zero, a graph of similarities.
  void check() const;
};

}  // namespace placegraph
