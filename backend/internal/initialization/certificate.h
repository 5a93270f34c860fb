#pragma once
#include <placegraph/backend/internal/initialization/isotropic_problem.h>

namespace placegraph {

/// What is proven of an estimate. Only the isotropic chordal problem is certified: that its global
/// minimum is near, not that the graph's own cost, which differs from it by the directions of the
/// information, kernels and measured positions, has no lower minimum. Fixed nodes are tied to each
/// other (held_node_constraints).
struct ChordalIsotropicCertificate {
  static constexpr const char* kProblem = "chordal_isotropic";
  /// relative_gap is at most CertificateOptions::max_relative_gap, and no pose is turned by more
  /// than 0.3 rad from the minimum that was found: that is the estimate's own.
  bool certified = false;
  double cost = 0;              ///< f at its minimum nearest to the estimate
  double cost_of_estimate = 0;  ///< f at the estimate itself
  double lower_bound = 0;       ///< of f over all poses
  /// CertificateMatrix::relative_gap of that minimum; of the estimate where it lies in another.
  double relative_gap = 0;
  double smallest_eigenvalue = 0;  ///< of the certificate matrix at that minimum
  double eigenvalue_scale = 0;     ///< mean diagonal entry it is to be compared with
};

struct CertificateOptions {
  double max_relative_gap = 1e-5;
};

/// Descends from the poses of `graph` to the nearest minimum of the isotropic problem and proves
/// how far that is from the global one at most.
template <class Group>
ChordalIsotropicCertificate certify_chordal_isotropic(const PackedGraph<Group>& graph,
                                                      RotationError rotation_error,
                                                      const CertificateOptions& options = {});

}  // namespace placegraph
