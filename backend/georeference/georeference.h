#pragma once
#include <placegraph/backend/georeference/fix_statistics.h>
#include <placegraph/backend/georeference/georeference_options.h>

#include <optional>
#include <vector>

namespace placegraph {

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
  int node = -1;  ///< position of the node it was carried to; -1: no motion or map at that time
  Eigen::Vector3d residual_enu = Eigen::Vector3d::Zero();  ///< antenna of the map minus fix [m]
  double sigma_horizontal_m = 0, sigma_vertical_m = 0;     ///< it was weighted with
  double weight = 0;                                       ///< of the kernel, in [0, 1]
  bool rejected = false;                                   ///< used, but with weight below 0.1
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
  std::vector<std::int64_t> unplaced_nodes;  ///< ids; of components whose fixes do not place them
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

/// Puts a map onto the earth: T_enu_node that minimize
///
///   sum rho(e^T Omega e) over the graph's edges + sum rho(|antenna - fix|^2 / sigma^2) over the
///   fixes
///
/// Steps: carry every fix to the node visited nearest in time (AntennaTrack); align each component
/// of the map robustly (align_to_fixes); optimize with Huber's kernel, taking the scatter of the
/// fixes from successive residuals and, where they contradict what the edges claim, that of the
/// edges by variance components (odometry_scatter.h); undo a delay of the map's poses that shows
/// clearly (map_latency.h); then with the chosen kernel; with the lever arm and the clock offset as
/// shared unknowns if they are to be estimated. Time without fixes is bridged by the edges; nothing
/// is extrapolated.
///
/// A delay and a clock offset show in the same way and mean different things. By default the stamps
/// are believed: a pose is that of its stamp by the clock of the fixes, and what lags is the map.
/// With estimate_clock_offset the poses are believed: they stay where the map has them, and the
/// clock of the fixes is off.
///
/// SE(2) graphs lie in the horizontal plane through the origin; Sim(3) graphs get their scale.
/// Outcomes: kTooFewData (fixes and map have no time in common, or too few), kNoConsensus and
/// kDegenerate as align_to_fixes, kNotConverged as optimize_pose_graph. Throws ArgumentError as
/// PoseGraph::check and AntennaTrack, and for an invalid fix or times of fixes that do not
/// increase.
[[nodiscard]] GeoreferenceResult georeference(const GeoreferenceInput& input,
                                              const GeoreferenceOptions& options,
                                              const LogSink& log = {});

}  // namespace placegraph
