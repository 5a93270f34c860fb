#pragma once
#include <placegraph/backend/linear/block_columns.h>

#include <Eigen/Core>

namespace placegraph {

/// The blocks of a matrix's inverse in the pattern of its Cholesky factor, including the diagonal.
/// By the recursion of Takahashi et al. 1973 (Erisman & Tinney 1975): from the last column to the
/// first every block follows from blocks already computed, at the cost of a second factorization.
/// `block_size` is that of the factor; the result has the factor's pattern, and its diagonal blocks
/// are full.
BlockFactor sparse_inverse(const BlockFactor& factor, int block_size);

/// Block (i, j) of the result of sparse_inverse; empty if it is not in the pattern.
Eigen::MatrixXd inverse_block(const BlockFactor& inverse, int block_size, int i, int j);

}  // namespace placegraph
