#pragma once
#include <placegraph/backend/pose_graph/pose_graph_options.h>
#include <placegraph/backend/pose_graph/pose_graph_report.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/pose_graph/constraint.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Optimizes a pose graph over SE(2), SE(3) or Sim(3): minimizes sum rho(e^T Omega e).
/// Every connected component is optimized by itself. Fixed nodes keep their poses; if a component
/// has neither a fixed node nor a measured position, its first node is held. Constraints that the
/// method of `options.robust` classifies as false are left out.
/// kNotConverged: a component has no minimum; the report has the last poses. Throws ArgumentError
/// as PoseGraph::check and for options out of range.
[[nodiscard]] PoseGraphReport optimize_pose_graph(PoseGraph graph, const PoseGraphOptions& options,
                                                  const LogSink& log = {});

/// e^T Omega e of every constraint, without kernels, in their order.
/// Throws as PoseGraph::check.
std::vector<double> chi2_by_constraint(const PoseGraph& graph, RotationError rotation_error);
/// Sum of e^T Omega e over all constraints, without kernels; throws as PoseGraph::check.
double chi2(const PoseGraph& graph, RotationError rotation_error);

}  // namespace placegraph
