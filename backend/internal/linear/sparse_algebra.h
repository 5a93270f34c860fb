#pragma once
#include <ceres/types.h>

namespace placegraph {

/// What Ceres factorizes sparse matrices with. SuiteSparse's supernodal Cholesky and its QR are
/// under the GPL; Eigen's are not, and slower (docs/licences.md).
constexpr ceres::SparseLinearAlgebraLibraryType kSparseAlgebra =
    PLACEGRAPH_GPL ? ceres::SUITE_SPARSE : ceres::EIGEN_SPARSE;

}  // namespace placegraph
