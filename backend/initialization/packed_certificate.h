#pragma once
#include <placegraph/backend/initialization/certificate.h>
#include <placegraph/backend/initialization/isotropic_problem.h>

namespace placegraph {

/// Certifies the poses of `graph`.
/// It descends from them to the nearest minimum of the isotropic problem and bounds its distance
/// from the global minimum.
template <class Group>
ChordalIsotropicCertificate certify_chordal_isotropic(const PackedGraph<Group>& graph,
                                                      RotationError rotation_error,
                                                      const CertificateOptions& options = {});

}  // namespace placegraph
