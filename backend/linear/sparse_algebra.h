#pragma once
#include <ceres/types.h>

namespace placegraph {

/// Library with which Ceres factorizes sparse matrices.
/// SuiteSparse's supernodal Cholesky and its QR are under the GPL; Eigen's are not, but slower
/// (docs/licences.md).
constexpr ceres::SparseLinearAlgebraLibraryType kSparseAlgebra =
    PLACEGRAPH_GPL ? ceres::SUITE_SPARSE : ceres::EIGEN_SPARSE;

}  // namespace placegraph
