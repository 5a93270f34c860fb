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

/// A time at which the vehicle was at a node, or so near that its pose is relative to it.
struct NodeVisit {
  std::int64_t stamp_ns = 0;  ///< by the clock of the nodes
  NodeId node;                ///< of the graph
};

/// A map, when its nodes were visited, and the fixes of a GPS receiver.
struct GeoreferenceInput {
  PoseGraph graph;  ///< T_map_node; fixed nodes become free, position constraints are left out
  std::vector<NodeVisit> visits;  ///< at least one; nodes without a visit are tied by edges only
  Trajectory motion;              ///< T_map_body between the nodes, in the same map; may be empty
  std::vector<GpsFix> fixes;      ///< by strictly ascending stamp
  Eigen::Vector3d lever_arm = Eigen::Vector3d::Zero();  ///< of the antenna in the nodes' frame [m]
  double clock_offset_s = 0;  ///< added to the stamps of the fixes to get the nodes' clock
  std::optional<GeodeticPosition> origin;  ///< of the ENU frame; default: the median of the fixes
};

/// The use that was made of one fix.
struct FixReport {
  /// Position in the result's `graph.nodes` of the node that the fix was carried to; nothing: there
  /// is no map or motion at its time.
  std::optional<int> node;
  Eigen::Vector3d residual_enu = Eigen::Vector3d::Zero();  ///< antenna by the map minus fix [m]
  double sigma_horizontal_m = 0, sigma_vertical_m = 0;     ///< standard deviations that were used
  double weight = 0;                                       ///< by the kernel, in [0, 1]
  bool rejected = false;                                   ///< used, but with a weight below 0.1
};

/// A time without a fix, within the time of the map.
struct GpsDropout {
  std::int64_t begin_ns = 0, end_ns = 0;  ///< by the nodes' clock
};

/// A georeferenced map, and what was estimated besides.
struct GeoreferenceResult {
  Outcome outcome;          ///< see georeference
  PoseGraph graph;          ///< T_enu_node, with the fixes as position constraints
  Trajectory trajectory;    ///< T_enu_body: the motion (or the nodes) after optimization
  GeodeticPosition origin;  ///< of the ENU frame
  /// The similarity that fits the first aligned component to its fixes, before optimization.
  Sim3 T_enu_map;
  double alignment_rmse_m = 0;         ///< of that similarity
  std::vector<FixReport> fixes;        ///< in the order of the input
  std::vector<GpsDropout> dropouts;    ///< in time order
  std::vector<NodeId> unplaced_nodes;  ///< of components that could not be aligned to their fixes
  int fixes_used = 0, fixes_rejected = 0;  ///< numbers of fixes; those without a node are neither
  double residual_rms_m = 0;               ///< of the fixes that were not rejected
  /// Factors on the fixes' stated standard deviations; 1 where they do not scatter more.
  double accuracy_factor_horizontal = 1, accuracy_factor_vertical = 1;
  /// Factors on the standard deviations of the edges' information; 1 where the fixes do not
  /// contradict it.
  double odometry_factor_translation = 1, odometry_factor_rotation = 1;
  /// Time by which the map's poses lagged behind their stamps; 0 where that is not clear (by three
  /// standard deviations).
  double map_delay_s = 0, map_delay_sigma_s = 0;
  Eigen::Vector3d lever_arm = Eigen::Vector3d::Zero();  ///< given or estimated, node frame [m]
  Eigen::Matrix3d lever_arm_covariance = Eigen::Matrix3d::Zero();  ///< zero where it was given
  /// Components whose standard deviation is below half of the prior's.
  Eigen::Array<bool, 3, 1> lever_arm_observable = Eigen::Array<bool, 3, 1>::Constant(false);
  double clock_offset_s = 0, clock_offset_sigma_s = 0;  ///< given or estimated; sigma 0: given
  int iterations = 0;                                   ///< of all optimizations together
};

}  // namespace placegraph
