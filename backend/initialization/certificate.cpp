#include <placegraph/backend/initialization/chordal_relaxation.h>
#include <placegraph/backend/initialization/held_nodes.h>
#include <placegraph/backend/initialization/certificate.h>
#include <placegraph/backend/initialization/isotropic_problem.h>
#include <placegraph/backend/initialization/rotation_agreement.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

template <class Group>
ChordalIsotropicCertificate certify_chordal_isotropic(const PackedGraph<Group>& graph,
                                                      RotationError rotation_error,
                                                      const CertificateOptions& options) {
  constexpr int dim = kSpaceDim<Group>;
  const IsotropicProblem<dim> problem = held_node_constraints(graph, rotation_error);
  ChordalIsotropicCertificate certificate;
  certificate.cost_of_estimate = isotropic_cost(problem, graph.poses);
  if (problem.edges.empty()) {
    certificate.certified = true;
    return certificate;
  }
  const ChordalRelaxation<dim> relaxation(problem);
  const Eigen::MatrixXd estimate = relaxation.point(graph.poses);
  Eigen::MatrixXd X = estimate;
  certificate.cost = relaxation.minimize(X).cost;
  CertificateMatrix<dim> matrix = relaxation.certificate_matrix(X);
  const auto curvature = matrix.curvature(0);
  certificate.smallest_eigenvalue = curvature.smallest_eigenvalue;
  certificate.eigenvalue_scale = matrix.scale();
  certificate.lower_bound = std::max(0.0, matrix.lower_bound(curvature.shift));
  const bool near = std::isfinite(certificate.cost_of_estimate) && points_agree<dim>(estimate, X);
  certificate.relative_gap = matrix.relative_gap(
      near ? certificate.cost : certificate.cost_of_estimate, certificate.lower_bound);
  certificate.certified = near && certificate.relative_gap <= options.max_relative_gap;
  return certificate;
}

ChordalIsotropicCertificate certify_chordal_isotropic(const PoseGraph& graph,
                                                      RotationError rotation_error) {
  graph.check();
  switch (graph.kind()) {
    case PoseKind::kSE2:
      return certify_chordal_isotropic(pack<SE2>(graph), rotation_error);
    case PoseKind::kSE3:
      return certify_chordal_isotropic(pack<SE3>(graph), rotation_error);
    case PoseKind::kSim3:
      break;
  }
  return certify_chordal_isotropic(pack<Sim3>(graph), rotation_error);
}

#define PLACEGRAPH_INSTANTIATE(Group)                             \
  template ChordalIsotropicCertificate certify_chordal_isotropic( \
      const PackedGraph<Group>&, RotationError, const CertificateOptions&);
PLACEGRAPH_INSTANTIATE(SE2)
PLACEGRAPH_INSTANTIATE(SE3)
PLACEGRAPH_INSTANTIATE(Sim3)
#undef PLACEGRAPH_INSTANTIATE

}  // namespace placegraph
