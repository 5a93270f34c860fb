#pragma once
#include <cstddef>
#include <vector>

namespace placegraph {

/// The pattern of the lower triangle of a block-sparse matrix by columns: column j has blocks in
/// the rows `row[start[j]], ..., row[start[j + 1] - 1]`, ascending, the diagonal one first.
struct BlockColumns {
  std::vector<int> start, row;
  int count() const { return static_cast<int>(start.size()) - 1; }
};

/// A block-sparse matrix as dense panels: column j of blocks is one column-major matrix of
/// block_size columns and `rows(j)` rows. Only the lower part of the diagonal block is used.
struct BlockPanels {
  int block_size = 0;
  BlockColumns pattern;
  std::vector<double> values;

  int rows(int j) const { return (pattern.start[j + 1] - pattern.start[j]) * block_size; }
  double* panel(int j) {
    return values.data() + static_cast<std::ptrdiff_t>(pattern.start[j]) * block_size * block_size;
  }
  const double* panel(int j) const { return const_cast<BlockPanels*>(this)->panel(j); }
};

/// A Cholesky factor L, L L^T = matrix, by blocks: `values` holds the blocks of `pattern` one after
/// the other, each column-major, the diagonal ones with zeros above the diagonal.
struct BlockFactor {
  BlockColumns pattern;
  std::vector<double> values;
};

}  // namespace placegraph
