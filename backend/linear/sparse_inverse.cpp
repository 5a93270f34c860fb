#include <placegraph/backend/linear/sparse_inverse.h>
#include <placegraph/graph/core/parallel.h>

#include <algorithm>

namespace placegraph {
namespace {

using Block = Eigen::Map<Eigen::MatrixXd>;
using ConstBlock = Eigen::Map<const Eigen::MatrixXd>;

}  // namespace

// With Z = (L L^T)^-1, Z L = L^-T is upper triangular with 1 / L_jj on its diagonal, hence by
// blocks below the diagonal of column j
//   Z_ij = -(sum_k Z_ik L_kj) L_jj^-1,       Z_jj = (L_jj^-T - sum_k Z_jk L_kj) L_jj^-1,
// k over the rows of column j below j. All Z_ik are in the pattern: the rows of one column are
// pairwise connected by fill.
BlockFactor sparse_inverse(const BlockFactor& factor, int block_size) {
  const BlockColumns& pattern = factor.pattern;
  const int count = pattern.count(), square = block_size * block_size;
  BlockFactor inverse{pattern, std::vector<double>(factor.values.size())};
  const auto L = [&](int k) {
    return ConstBlock(&factor.values[static_cast<std::size_t>(k) * square], block_size, block_size);
  };
  const auto Z = [&](int k) {
    return Block(&inverse.values[static_cast<std::size_t>(k) * square], block_size, block_size);
  };
  std::vector<int> place(static_cast<std::size_t>(count), -1);  // position of a row in column j
  for (int j = count - 1; j >= 0; --j) {
    check_interruption();
    const int diagonal = pattern.start[j], end = pattern.start[j + 1];
    for (int k = diagonal + 1; k < end; ++k) place[pattern.row[k]] = k;
    for (int k = diagonal + 1; k < end; ++k) {
      const int column = pattern.row[k];
      Z(k).noalias() -= Z(pattern.start[column]) * L(k);
      for (int q = pattern.start[column] + 1; q < pattern.start[column + 1]; ++q) {
        const int i = place[pattern.row[q]];
        if (i <= diagonal || i >= end) continue;
        Z(i).noalias() -= Z(q) * L(k);
        Z(k).noalias() -= Z(q).transpose() * L(i);
      }
    }
    const Eigen::MatrixXd L_inverse = L(diagonal).triangularView<Eigen::Lower>().solve(
        Eigen::MatrixXd::Identity(block_size, block_size));
    Eigen::MatrixXd own = L_inverse.transpose();
    for (int k = diagonal + 1; k < end; ++k) {
      Z(k) = (Z(k) * L_inverse).eval();
      own.noalias() -= Z(k).transpose() * L(k);
    }
    own = (own * L_inverse).eval();
    Z(diagonal) = 0.5 * (own + own.transpose());
    for (int k = diagonal + 1; k < end; ++k) place[pattern.row[k]] = -1;
  }
  return inverse;
}

Eigen::MatrixXd inverse_block(const BlockFactor& inverse, int block_size, int i, int j) {
  const int column = std::min(i, j), row = std::max(i, j);
  const auto begin = inverse.pattern.row.begin() + inverse.pattern.start[column];
  const auto end = inverse.pattern.row.begin() + inverse.pattern.start[column + 1];
  const auto found = std::lower_bound(begin, end, row);
  if (found == end || *found != row) return {};
  const std::size_t first =
      static_cast<std::size_t>(found - inverse.pattern.row.begin()) * block_size * block_size;
  const ConstBlock block(&inverse.values[first], block_size, block_size);
  if (i < j) return block.transpose();
  return block;
}

}  // namespace placegraph
