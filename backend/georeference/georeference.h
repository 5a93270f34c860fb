#pragma once
#include <placegraph/backend/georeference/georeference_options.h>
#include <placegraph/backend/georeference/georeference_report.h>
#include <placegraph/graph/core/log.h>

namespace [[gnu::visibility("default")]] placegraph {

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
