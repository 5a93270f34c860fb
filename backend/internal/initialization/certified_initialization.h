#pragma once
#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/backend/internal/solver/packed_graph.h>

namespace placegraph {

struct CertifiedInitializationReport {
  double cost = 0;         ///< of the isotropic chordal problem at the poses that were set
  double lower_bound = 0;  ///< of that problem, as far as it was proven
  double relative_gap = 0;
  int rank = 0;        ///< to which the relaxation had to be lifted; d: not at all
  double effort = 0;   ///< ChordalRelaxation::Descent::effort, all in all
  bool tight = false;  ///< the poses are the problem's global minimum, to a gap of 1e-5
};

/// Sets the poses to a minimum of the isotropic chordal problem that is the global one wherever its
/// relaxation is tight: a descent from the poses in `graph` (the chordal start serves), then the
/// Riemannian staircase (Boumal et al. 2016; Rosen et al. 2019, algorithm 2): while the certificate
/// matrix has a negative eigenvalue, one dimension more, along its eigenvector, and down again; the
/// critical point of the last rank is rounded to rotations and descended from once more; the lower
/// of the two minima is taken. Held nodes stay; several held ones of a component are tied to each
/// other by stiff edges, and one of them places it. Measured positions only place what nothing
/// holds. Sim(3): the scales in `graph` are kept.
///
/// A descent takes no more than 0.4 of `max_effort` (in Gauss-Newton iterations on the graph, by
/// operations), and nothing is lifted or searched for when that is spent: where the relaxation is
/// not tight the staircase climbs for long and gains little.
template <class Group>
CertifiedInitializationReport certified_initialization_of(
    PackedGraph<Group>& graph, RotationError rotation_error = RotationError::kLog,
    double max_effort = 3000);

/// Whether the poses are, or lie by a minimum of the isotropic chordal problem that is, its global
/// minimum to a gap of 1e-5: looked for at the poses themselves, which costs one factorization and
/// is enough where the information is isotropic, and then at the end of a short descent from them
/// if that turns no pose by more than 0.3 rad. Far cheaper than certified_initialization_of; false
/// says nothing but that this did not prove it.
template <class Group>
bool certified_as_they_are(const PackedGraph<Group>& graph,
                           RotationError rotation_error = RotationError::kLog);

}  // namespace placegraph
