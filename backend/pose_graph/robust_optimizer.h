#pragma once
#include <placegraph/backend/robust/loop_set_growth.h>

#include <string>

namespace placegraph {

enum class RobustMethod { kNone, kHuber, kDcs, kGnc, kPcm, kAuto };

struct RobustOptions {
  RobustMethod method = RobustMethod::kNone;
  double kernel_width = 1;  ///< of huber and dcs, in standard deviations
  /// Share of the true loops whose squared error lies below the gate, were their noise Gaussian.
  double gate_probability = 0.999;
  GncOptions gnc = {};
  LoopSupportOptions support;
  LoopGrowthOptions growth;
  void check() const;
};
void visit(OptionVisitor& field, RobustOptions& options);

/// A constraint that was left out of the solution.
struct RejectedEdge {
  int constraint = 0;  ///< position in PoseGraph::constraints
  double chi2 = 0;     ///< e^T Omega e at the solution
  /// The first that holds of "inconsistent with odometry": no drift of the odometry explains it,
  /// "pairwise": no loop nearby agrees with it, "residual": its error lies beyond the gate.
  std::string reason;
};

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
