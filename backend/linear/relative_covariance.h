#pragma once
#include <placegraph/graph/pose_graph/constraint.h>

namespace placegraph {

/// Covariance of T_from_to in its right tangent from the joint covariance of both poses.
/// With Ad the adjoint of T_to_from, d T_from_to = d to - Ad d from, so that
/// Sigma = S_to - Ad S_from_to - S_from_to^T Ad^T + Ad S_from Ad^T.
inline Information relative_covariance(const Information& adjoint_to_from,
                                       const Information& S_from, const Information& S_to,
                                       const Information& S_from_to) {
  const Information& A = adjoint_to_from;
  const Information cross = A * S_from_to;
  const Information sum = S_to - cross - cross.transpose() + A * S_from * A.transpose();
  return 0.5 * (sum + sum.transpose());
}

}  // namespace placegraph
