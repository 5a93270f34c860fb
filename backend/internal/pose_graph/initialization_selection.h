#pragma once
#include <placegraph/backend/internal/solver/local_solver.h>
#include <placegraph/backend/pose_graph/pose_graph_options.h>

namespace placegraph {

/// Sets the poses to a start; kAuto and kFile leave them.
template <class Group>
void set_initialization(PackedGraph<Group>& graph, PoseGraphInitialization start,
                        RotationError rotation_error);

struct InitializedSolution {
  LocalSolution solution;  ///< of the descent that was kept; iterations of all of them
  PoseGraphInitialization used = PoseGraphInitialization::kFile;  ///< never kAuto
  bool refined_from_certified = false;                            ///< used == kCertified
};

/// Solves `graph` from a start. kAuto:
///
///   1. down from the poses as they are if no edge's rotation is off by more than 0.5 rad there,
///   else
///      from them or the chordal start, whichever costs less;
///   2. the minimum is kept if the descent ended and `windings_are_settled` or, where they are in
///   doubt, it is `certified_as_they_are`;
///   3. else the certified start: if its relaxation is tight and it is turned from the minimum by
///   no more than 0.3 rad anywhere, the minimum is kept; else down from it as well and, where the
///   relaxation is not tight, from the dearer one of the first two, from the odometry start and
///   from the `incremental_initialization_of`; of the descents that ended the lowest minimum is
///   kept.
///
/// In operations, the certified start is given up where it costs more than five times the first
/// descent (and 200 iterations), the replay where it costs more than ten times. A descent of kAuto
/// or kCertified that runs out of iterations while it falls goes on, up to four times, if it has
/// come within twice the lowest minimum.
template <class Group>
InitializedSolution solve_from_initialization(PackedGraph<Group>& graph,
                                              PoseGraphInitialization start,
                                              RotationError rotation_error,
                                              LocalSolver<Group>& solver);

/// Whether a minimum is beyond doubt as far as rotations go. Wrong minima of a pose graph are
/// wound: around some cycle the residual rotations add up to a full turn too much. For every edge
/// outside a breadth-first spanning tree let s be the sum of the residual rotations around the
/// cycle that it closes and sigma^2 their variance by the scatter of all residuals (so no scale of
/// the information matters). The cycle wound once less would have the sum 2 pi - |s|; that is less
/// likely by exp(-((2 pi - |s|)^2 - s^2) / (2 sigma^2)), and settled if that is below exp(-6) for
/// every cycle.
template <class Group>
bool windings_are_settled(const PackedGraph<Group>& graph);

}  // namespace placegraph
