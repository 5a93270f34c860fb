#pragma once
#include <placegraph/backend/internal/robust/loop_set_growth.h>
#include <placegraph/backend/pose_graph/pose_graph_options.h>
#include <placegraph/backend/pose_graph/pose_graph_report.h>

#include <string>

namespace placegraph {

struct RobustSolution {
  LocalSolution local;
  std::vector<RejectedEdge> rejected;  ///< in the order of the constraints
  double noise_scale = 1;  ///< variance of the noise in units of what the information claims
  bool judged = true;      ///< false: too few loops to know that scale; none was left out
};

/// Minimizes a pose graph some of whose loops are false. Odometry (and measured positions) are
/// believed, of several odometry edges between the same nodes one (parallel_odometry.h); every
/// other edge may be left out.
///   none   all edges as they are, with the kernels they carry
///   huber, dcs   that kernel on every loop; none is left out
///   gnc    graduated non-convexity from the poses of the graph (gnc.h), with the gate calibrated
///          by rings of neighbouring loops (loop_support.h), then every loop tested against the
///          solution (settle_loops)
///   pcm    the largest set of loops that agree each with each over all odometry between them
///          (pcm.h), then every loop tested against the solution that follows (loop_growth.h)
///   auto   the plain minimum if its errors show that no loop is false, else loop_growth.h
/// Where too few loops agree to know the scale of the noise (LoopSupport::scale_is_known), gnc, pcm
/// and auto judge none: the plain minimum, and a warning.
/// With `free_start` auto's plain descent may begin at the chordal start instead of the poses.
/// `graph` comes out with the poses of the solution and weight 0 on what was left out.
template <class Group>
[[nodiscard]] RobustSolution solve_robustly(PackedGraph<Group>& graph,
                                            const LocalSolverOptions& solver,
                                            const RobustOptions& options, bool free_start = false);

}  // namespace placegraph
