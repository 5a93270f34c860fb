#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/geodesy.h>
#include <placegraph/graph/geometry/sim3.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/measurements/gps_fix.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A time at which the vehicle was at a node, or so near that it is described relative to it.
struct NodeVisit {
  std::int64_t stamp_ns = 0;
  NodeId node;
};

/// A map, when its nodes were visited, and what a GPS receiver saw meanwhile.
struct GeoreferenceInput {
  PoseGraph graph;  ///< T_map_node; its fixed nodes are set free, its positions left out
  std::vector<NodeVisit> visits;  ///< at least one; nodes without a visit are tied by edges only
  Trajectory motion;              ///< T_map_body between the nodes, in the same map; may be empty
  std::vector<GpsFix> fixes;      ///< in time order
  Eigen::Vector3d lever_arm = Eigen::Vector3d::Zero();  ///< of the antenna in the nodes' frame [m]
  double clock_offset_s = 0;                            ///< added to the stamps of the fixes
  std::optional<GeodeticPosition> origin;  ///< of the ENU frame; default: the median of the fixes
};

/// What became of one fix.
struct FixReport {
  /// Position of the node it was carried to; nothing: no motion or map at that time.
  std::optional<int> node;
  Eigen::Vector3d residual_enu = Eigen::Vector3d::Zero();  ///< antenna of the map minus fix [m]
  double sigma_horizontal_m = 0, sigma_vertical_m = 0;     ///< it was weighted with
  double weight = 0;                                       ///< of the kernel, in [0, 1]
  bool rejected = false;                                   ///< used, but with weight below 0.1
};

/// A time without a fix, inside of the map's time.
struct GpsDropout {
  std::int64_t begin_ns = 0, end_ns = 0;  ///< by the nodes' clock
};

struct GeoreferenceResult {
  Outcome outcome;
  PoseGraph graph;        ///< T_enu_node, with the fixes as position constraints
  Trajectory trajectory;  ///< T_enu_body: the motion (or the nodes) after optimization
  GeodeticPosition origin;
  /// Where the map lay before it was unbent: the similarity that fits its first component.
  Sim3 T_enu_map;
  double alignment_rmse_m = 0;
  std::vector<FixReport> fixes;  ///< in the order of the input
  std::vector<GpsDropout> dropouts;
  std::vector<NodeId> unplaced_nodes;  ///< of components whose fixes do not place them
  int fixes_used = 0, fixes_rejected = 0;
  double residual_rms_m = 0;  ///< of the fixes that were not rejected
  /// How much more the fixes scatter than the receiver states; 1 if not.
  double accuracy_factor_horizontal = 1, accuracy_factor_vertical = 1;
  /// How much more the edges scatter than their information claims, in standard deviations; 1 if
  /// the fixes do not contradict it.
  double odometry_factor_translation = 1, odometry_factor_rotation = 1;
  /// By which the map's poses lagged behind their stamps; 0 where that is not clear (3 deviations).
  double map_delay_s = 0, map_delay_sigma_s = 0;
  Eigen::Vector3d lever_arm = Eigen::Vector3d::Zero();             ///< [m]
  Eigen::Matrix3d lever_arm_covariance = Eigen::Matrix3d::Zero();  ///< zero where it was given
  /// Components that the data fix better than half of the prior's deviation.
  Eigen::Array<bool, 3, 1> lever_arm_observable = Eigen::Array<bool, 3, 1>::Constant(false);
  double clock_offset_s = 0, clock_offset_sigma_s = 0;
  int iterations = 0;
};

}  // namespace placegraph
