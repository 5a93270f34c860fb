#pragma once
#include <placegraph/backend/georeference/georeference_options.h>
#include <placegraph/backend/georeference/georeference_report.h>
#include <placegraph/graph/core/log.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Georeferences a map by GPS fixes. The poses T_enu_node minimize:
///
///   sum rho(e^T Omega e) over the graph's edges + sum rho(|antenna - fix|^2 / sigma^2) over the
///   fixes
///
/// Steps: carry every fix to the node visited nearest in time; align each component of the map
/// robustly; optimize with Huber's kernel, estimating the scatter of the fixes from successive
/// residuals and, where they contradict the information of the edges, that of the edges as variance
/// components; correct a latency of the map's poses that is clear; then optimize with the chosen
/// kernel. Lever arm and clock offset are shared unknowns if they are to be estimated. Time without
/// fixes is bridged by the edges; nothing is extrapolated. See docs/georeference.md.
///
/// A latency of the poses and an offset of the clock cause the same misfit. By default the clocks
/// are trusted, and the misfit is attributed to poses that lag behind their stamps. With
/// estimate_clock_offset the poses stay where the map has them, and the misfit is attributed to the
/// clock of the fixes.
///
/// SE(2) graphs lie in the horizontal plane through the origin; Sim(3) graphs get their scale.
/// Outcomes: kTooFewData (fixes and map have too little time in common), kNoConsensus (too few
/// fixes agree with the shape of the map), kDegenerate (the fixes leave a rotation or the
/// calibration undetermined), kNotConverged as optimize_pose_graph. Throws ArgumentError as
/// PoseGraph::check, for options out of range, an empty graph, visits or motion that are invalid,
/// an invalid fix, or times of fixes that do not increase.
[[nodiscard]] GeoreferenceResult georeference(const GeoreferenceInput& input,
                                              const GeoreferenceOptions& options,
                                              const LogSink& log = {});

}  // namespace placegraph
