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

/// A time at which the vehicle was at a node, or near enough for a pose relative to it.
struct NodeVisit {
  std::int64_t stamp_ns = 0;  ///< time [ns], by the clock of the nodes
  NodeId node;                ///< visited node of the graph
};

/// A map, the times at which its nodes were visited, and the fixes of a GPS receiver.
struct GeoreferenceInput {
  PoseGraph graph;  ///< T_map_node; fixed nodes become free, position constraints are left out
  std::vector<NodeVisit> visits;  ///< at least one; edges alone constrain unvisited nodes
  Trajectory motion;              ///< T_map_body between the nodes, in the same map; may be empty
  std::vector<GpsFix> fixes;      ///< fixes, strictly ascending stamps
  Eigen::Vector3d lever_arm = Eigen::Vector3d::Zero();  ///< antenna in the nodes' frame [m]
  double clock_offset_s = 0;  ///< stamp of a fix + offset = time by the nodes' clock [s]
  std::optional<GeodeticPosition> origin;  ///< ENU origin; default: median of the fixes
};

/// Residual and weight of one fix.
struct FixReport {
  /// Position in the result's `graph.nodes` of the node that the fix was transferred to; empty if
  /// there is no map or motion at the time of the fix.
  std::optional<int> node;
  Eigen::Vector3d residual_enu = Eigen::Vector3d::Zero();  ///< estimated antenna minus fix [m]
  double sigma_horizontal_m = 0, sigma_vertical_m = 0;     ///< standard deviations used
  double weight = 0;                                       ///< weight by the kernel, in [0, 1]
  bool rejected = false;                                   ///< used, but with a weight below 0.1
};

/// The scale that the fixes give to a map without one.
struct MapScale {
  double metres_per_unit = 1;  ///< geometric mean over the nodes of the first placed component
  double sigma = 0;  ///< standard deviation of that mean [m per unit]; infinite: undetermined
};

/// A gap between fixes within the time of the map.
struct GpsDropout {
  std::int64_t begin_ns = 0, end_ns = 0;  ///< first and last time [ns], by the nodes' clock
};

/// A georeferenced map, and the calibration and statistics estimated with it.
struct GeoreferenceResult {
  Outcome outcome;          ///< outcome, see georeference
  PoseGraph graph;          ///< T_enu_node, with the fixes as position constraints
  Trajectory trajectory;    ///< T_enu_body: the motion (or the nodes) after optimization
  GeodeticPosition origin;  ///< origin of the ENU frame
  /// The similarity that fits the first aligned component to its fixes, before optimization.
  Sim3 T_enu_map;
  double alignment_rmse_m = 0;             ///< RMS error of that similarity [m]
  std::optional<MapScale> scale;           ///< scale of a Sim(3) map; empty: the map has one
  std::vector<FixReport> fixes;            ///< one per fix of the input
  std::vector<GpsDropout> dropouts;        ///< gaps between fixes, in time order
  std::vector<NodeId> unplaced_nodes;      ///< nodes of components that could not be aligned
  int fixes_used = 0, fixes_rejected = 0;  ///< numbers; a fix without a node is in neither
  double residual_rms_m = 0;               ///< RMS residual of the fixes not rejected [m]
  /// Factors of the fixes' stated standard deviations; 1 if the fixes do not scatter more.
  double accuracy_factor_horizontal = 1, accuracy_factor_vertical = 1;
  /// Factors of the standard deviations of the edges' information; 1 if the fixes do not contradict
  /// it.
  double odometry_factor_translation = 1, odometry_factor_rotation = 1;
  /// Latency of the map's poses and its standard deviation [s].
  /// The poses lagged behind their stamps by this time; 0 if the latency is below three standard
  /// deviations.
  double map_delay_s = 0, map_delay_sigma_s = 0;
  Eigen::Vector3d lever_arm = Eigen::Vector3d::Zero();  ///< given or estimated, node frame [m]
  Eigen::Matrix3d lever_arm_covariance = Eigen::Matrix3d::Zero();  ///< [m^2]; zero if given
  /// Whether a component's standard deviation is below half of that of the prior.
  Eigen::Array<bool, 3, 1> lever_arm_observable = Eigen::Array<bool, 3, 1>::Constant(false);
  double clock_offset_s = 0, clock_offset_sigma_s = 0;  ///< [s]; sigma 0: given
  int iterations = 0;                                   ///< sum over all optimizations
};

}  // namespace placegraph
