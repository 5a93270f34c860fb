#pragma once
#include <placegraph/backend/pose_graph/pose_graph_options.h>
#include <placegraph/backend/solver/local_solver.h>

namespace placegraph {

/// Sets the poses to an initialization; kAuto and kFile leave them unchanged.
template <class Group>
void set_initialization(PackedGraph<Group>& graph, PoseGraphInitialization initialization,
                        RotationError rotation_error);

struct InitializedSolution {
  LocalSolution solution;  ///< result of the selected descent; total iterations of all descents
  PoseGraphInitialization used = PoseGraphInitialization::kFile;  ///< never kAuto
  bool refined_from_certified = false;                            ///< used == kCertified
};

/// Solves `graph` from an initialization. kAuto:
///
///   1. a descent from the given poses if no edge's rotation error exceeds 0.5 rad there, else from
///      the given poses or the chordal initialization, whichever has the lower cost;
///   2. the minimum is kept if the descent converged and `windings_are_settled` or, if they are in
///      doubt, it is `certified_as_they_are`;
///   3. else the certified initialization: if its relaxation is tight and it is rotated from the
///      minimum by no more than 0.3 rad anywhere, the minimum is kept; else a descent from it as
///      well and, if the relaxation is not tight, from the costlier of the first two, from the
///      odometry initialization and from the `initialize_incrementally`; of the descents that
///      converged the lowest minimum is kept.
///
/// The certified initialization is aborted if its operations exceed five times those of the first
/// descent (and 200 iterations), the replay if they exceed ten times. A descent of kAuto or
/// kCertified that reaches the maximum number of iterations while its cost decreases is continued,
/// up to four times, if its cost is below twice the lowest minimum.
template <class Group>
InitializedSolution solve_from_initialization(PackedGraph<Group>& graph,
                                              PoseGraphInitialization initialization,
                                              RotationError rotation_error,
                                              LocalSolver<Group>& solver);

/// Whether the rotations of a minimum are certainly correct.
/// At wrong minima of a pose graph the residual rotations around some cycle add up to a multiple of
/// 360 deg too much. For every edge outside a breadth-first spanning tree let s be the sum of the
/// residual rotations around the cycle that it closes and sigma^2 their variance by the dispersion
/// of all residuals (so the scale of the information has no effect). With one winding less the sum
/// would be 2 pi - |s|, which is less likely by the factor exp(-((2 pi - |s|)^2 - s^2) / (2
/// sigma^2)). The windings are settled if this factor is below exp(-6) for every cycle.
template <class Group>
bool windings_are_settled(const PackedGraph<Group>& graph);

}  // namespace placegraph
