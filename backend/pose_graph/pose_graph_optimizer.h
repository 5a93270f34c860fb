#pragma once
#include <placegraph/backend/pose_graph/pose_graph_options.h>
#include <placegraph/backend/pose_graph/pose_graph_report.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/pose_graph/constraint.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Minimizes sum rho(e^T Omega e) over the nodes that are not fixed, leaving out what
/// `options.robust` finds to be false; if a connected component has
/// no fixed node its first one is held. SE(2), SE(3) and Sim(3) graphs. Throws as PoseGraph::check.
[[nodiscard]] PoseGraphReport optimize_pose_graph(PoseGraph graph, const PoseGraphOptions& options,
                                                  const LogSink& log = {});

/// Sum of e^T Omega e over all relative-pose constraints (and positions), without kernels.
double chi2(const PoseGraph& graph, RotationError rotation_error);

}  // namespace placegraph
