#pragma once
#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/backend/solver/packed_graph.h>

namespace placegraph {

struct CertifiedInitializationReport {
  double cost = 0;         ///< cost of the isotropic chordal problem at the resulting poses
  double lower_bound = 0;  ///< proven lower bound of that cost
  double relative_gap = 0;
  int rank = 0;        ///< rank to which the relaxation was lifted; d: not lifted
  double effort = 0;   ///< total ChordalRelaxation::Descent::effort
  bool tight = false;  ///< whether the poses are the global minimum up to a gap of 1e-5
};

/// Sets the poses to a minimum of the isotropic chordal problem.
/// It is the global minimum if the relaxation is tight. The algorithm is a descent from the poses
/// in `graph` (e.g. the chordal initialization), then the Riemannian staircase (Boumal et al. 2016;
/// Rosen et al. 2019, algorithm 2): while the certificate matrix has a negative eigenvalue, the
/// dimension is increased by one and a descent starts along the eigenvector. The critical point of
/// the last rank is rounded to rotations, from which a further descent starts; the lower of the two
/// minima is used. Held nodes keep their poses; several held nodes of a component are connected to
/// each other by stiff edges, and one of them fixes the component. Measured positions only place
/// components without held nodes. Sim(3): the scales in `graph` are kept.
///
/// A descent takes no more than 0.4 of `max_effort` (in Gauss-Newton iterations on the graph, by
/// operations), and after `max_effort` the relaxation is not lifted and no eigenvalue is searched:
/// if the relaxation is not tight, the staircase takes many steps and gains little.
template <class Group>
CertifiedInitializationReport initialize_certified(
    PackedGraph<Group>& graph, RotationError rotation_error = RotationError::kLog,
    double max_effort = 3000);

/// Whether the poses are at or near the global minimum of the isotropic chordal problem.
/// The gap is at most 1e-5. The poses themselves are tested first, which costs one factorization
/// and is sufficient for isotropic information, then the end of a short descent from them, if it
/// rotates no pose by more than 0.3 rad. Far cheaper than initialize_certified; false means
/// only that this test found no proof.
template <class Group>
bool certified_as_they_are(const PackedGraph<Group>& graph,
                           RotationError rotation_error = RotationError::kLog);

}  // namespace placegraph
