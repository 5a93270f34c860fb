#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>

namespace [[gnu::visibility("default")]] placegraph {

template <class Group>
struct PackedGraph;

/// The certificate of an estimate.
/// Only the isotropic chordal problem is certified: its global minimum is near. The graph's own
/// cost, which also has the directions of the information, kernels and measured positions, may have
/// a lower minimum. Fixed nodes are connected to each other (held_node_constraints).
struct ChordalIsotropicCertificate {
  static constexpr const char* kProblem = "chordal_isotropic";
  /// relative_gap is at most CertificateOptions::max_relative_gap, and no pose is rotated by more
  /// than 0.3 rad from the minimum that was found, which is therefore that of the estimate.
  bool certified = false;
  double cost = 0;              ///< f at its minimum nearest to the estimate
  double cost_of_estimate = 0;  ///< f at the estimate itself
  double lower_bound = 0;       ///< lower bound of f over all poses
  /// CertificateMatrix::relative_gap of that minimum; of the estimate if it belongs to another
  /// minimum.
  double relative_gap = 0;
  double smallest_eigenvalue = 0;  ///< that of the certificate matrix at that minimum
  double eigenvalue_scale = 0;     ///< mean diagonal entry, for comparison with the eigenvalue
};

/// Tolerances of a certificate.
struct CertificateOptions {
  double max_relative_gap = 1e-5;
};

/// Certifies the poses of `graph`.
///
/// It descends from them to the nearest minimum of the isotropic problem and bounds its distance
/// from the global minimum.
template <class Group>
ChordalIsotropicCertificate certify_chordal_isotropic(const PackedGraph<Group>& graph,
                                                      RotationError rotation_error,
                                                      const CertificateOptions& options = {});
/// Certifies the poses of a pose graph, from which false constraints were removed.
///
/// It descends from them to the nearest minimum of the isotropic problem and bounds its distance
/// from the global minimum. Throws as PoseGraph::check.
ChordalIsotropicCertificate certify_chordal_isotropic(const PoseGraph& graph,
                                                      RotationError rotation_error);

}  // namespace placegraph
