#pragma once
#include <placegraph/backend/georeference/georeference_options.h>
#include <placegraph/backend/georeference/georeference_report.h>
#include <placegraph/graph/core/log.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Georeferences a map with GPS fixes; the estimated poses T_enu_node minimize:
///
///   sum rho(e^T Omega e) over the graph's edges + sum rho(|antenna - fix|^2 / sigma^2) over the
///   fixes
///
/// Steps: transfer every fix to the node that was visited nearest in time; align each component of
/// the map robustly; optimize with Huber's kernel, and estimate the dispersion of the fixes from
/// successive residuals and, where the fixes contradict the information of the edges, the
/// dispersion of the edges as variance components; correct a latency of the map's poses if it is
/// significant; optimize with the chosen kernel. Lever arm and clock offset are shared unknowns if
/// they are estimated. Gaps between fixes are bridged by the edges; nothing is extrapolated. See
/// docs/georeference.md.
///
/// A latency of the poses and an offset of the clock cause the same misfit. By default the misfit
/// is attributed to poses that lag behind their stamps, and the clocks are assumed to agree. With
/// estimate_clock_offset the misfit is attributed to the clock of the fixes, and the latency of the
/// poses is not corrected.
///
/// SE(2) graphs are in the horizontal plane through the origin; the scale of Sim(3) graphs is
/// estimated. Outcomes: kTooFewData (fixes and map overlap too little in time), kNoConsensus (too
/// few fixes agree with the shape of the map), kDegenerate (the fixes leave a rotation or the
/// calibration undetermined), kNotConverged as optimize_pose_graph. Throws ArgumentError as
/// PoseGraph::check, for options out of range, an empty graph, visits or motion that are invalid,
/// an invalid fix, or times of fixes that do not increase.
[[nodiscard]] GeoreferenceResult georeference(const GeoreferenceInput& input,
                                              const GeoreferenceOptions& options,
                                              const LogSink& log = {});

}  // namespace placegraph
