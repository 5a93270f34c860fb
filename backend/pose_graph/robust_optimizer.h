#pragma once
#include <placegraph/backend/pose_graph/pose_graph_options.h>
#include <placegraph/backend/pose_graph/pose_graph_report.h>
#include <placegraph/backend/robust/loop_set_growth.h>

#include <string>

namespace placegraph {

struct RobustSolution {
  LocalSolution local;
  std::vector<RejectedEdge> rejected;  ///< in the order of the constraints
  double noise_scale = 1;              ///< variance of the noise relative to the information
  bool judged = true;  ///< false: too few loops to estimate that scale; none was left out
};

/// Minimizes a pose graph of one component with false loops.
/// Odometry and measured positions are accepted, but only one of several odometry edges between the
/// same nodes (parallel_odometry.h); every other edge may be left out.
///   none   all edges, with their own kernels
///   huber, dcs   this kernel on every loop; none is left out
///   gnc    graduated non-convexity from the poses of the graph (gnc.h), with the gate calibrated
///          by rings of neighbouring loops (loop_clusters.h), then every loop tested against the
///          solution (settle_loops)
///   pcm    the largest set of pairwise consistent loops over all odometry between them (pcm.h),
///          then every loop tested against the resulting solution (loop_set_growth.h)
///   auto   the plain minimum if its errors show that no loop is false, else loop_set_growth.h
/// The solution of gnc is compared with that of pcm, and so is that of auto if most of the loops it
/// rejects support each other or if it needs far more noise than the rings of neighbouring loops:
/// the one of lower truncated cost, with the gate of the rings, is kept.
/// If too few loops agree to estimate the scale of the noise (LoopSupport::scale_is_known), gnc,
/// pcm and auto test no loop: they return the plain minimum, with `judged` false.
/// With `free_start` the plain descent of auto may start from the chordal initialization instead of
/// the given poses. On return `graph` has the poses of the solution, and weight 0 for the edges
/// that were left out.
template <class Group>
[[nodiscard]] RobustSolution solve_robustly(PackedGraph<Group>& graph,
                                            const LocalSolverOptions& solver,
                                            const RobustOptions& options, bool free_start = false);

}  // namespace placegraph
