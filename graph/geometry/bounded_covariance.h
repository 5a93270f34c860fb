#pragma once
#include <placegraph/graph/geometry/sim3.h>

namespace placegraph {

/// Inverse of a positive semi-definite matrix. Eigenvalues below `floor`, or below 1e-12 of the
/// largest, are replaced by that bound, so that the inverse is finite.
Matrix6d bounded_inverse(const Matrix6d& matrix, double floor);
Matrix7d bounded_inverse(const Matrix7d& matrix, double floor);

/// Covariance that corresponds to `information`; no direction has a variance above 1e6.
Matrix6d bounded_covariance(const Matrix6d& information);
Matrix7d bounded_covariance(const Matrix7d& information);

}  // namespace placegraph
