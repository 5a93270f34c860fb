#include <gtest/gtest.h>
#include <placegraph/backend/linear/sparse_inverse.h>
#include <placegraph/graph/core/random.h>

#include <Eigen/Dense>
#include <algorithm>
#include <set>

namespace placegraph {
namespace sparse_inverse_test {

/// The rows of every column of a Cholesky factor with random entries and all their fill.
std::vector<std::set<int>> random_pattern(int count, double density, Random& random) {
  std::vector<std::set<int>> rows(static_cast<std::size_t>(count));
  for (int j = 0; j < count; ++j) {
    for (int i = j + 1; i < count; ++i)
      if (random.uniform() < density) rows[j].insert(i);
    // Eliminating a column connects all its rows.
    for (const int a : rows[j])
      for (const int b : rows[j])
        if (a < b) rows[a].insert(b);
  }
  return rows;
}

BlockFactor random_factor(int count, int size, double density, Random& random) {
  const auto rows = random_pattern(count, density, random);
  BlockFactor factor;
  const auto add_block = [&](int row, bool diagonal) {
    factor.pattern.row.push_back(row);
    for (int c = 0; c < size; ++c)
      for (int r = 0; r < size; ++r)
        factor.values.push_back(!diagonal || r > c ? 0.3 * random.normal()
                                : r == c           ? random.uniform(1, 2)
                                                   : 0);
  };
  for (int j = 0; j < count; ++j) {
    factor.pattern.start.push_back(static_cast<int>(factor.pattern.row.size()));
    add_block(j, true);
    for (const int i : rows[j]) add_block(i, false);
  }
  factor.pattern.start.push_back(static_cast<int>(factor.pattern.row.size()));
  return factor;
}

Eigen::MatrixXd dense(const BlockFactor& factor, int size) {
  const int count = factor.pattern.count();
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(count * size, count * size);
  for (int j = 0; j < count; ++j)
    for (int k = factor.pattern.start[j]; k < factor.pattern.start[j + 1]; ++k)
      L.block(factor.pattern.row[k] * size, j * size, size, size) =
          Eigen::Map<const Eigen::MatrixXd>(&factor.values[k * size * size], size, size);
  return L;
}

TEST(SparseInverse, IsTheDenseInverseInThePatternOfTheFactor) {
  Random random(1);
  for (const int size : {1, 3, 6})
    for (const double density : {0.0, 0.1, 0.3, 1.0}) {
      constexpr int kBlocks = 12;
      const BlockFactor factor = random_factor(kBlocks, size, density, random);
      const BlockFactor inverse = sparse_inverse(factor, size);
      const Eigen::MatrixXd L = dense(factor, size);
      const Eigen::MatrixXd expected = (L * L.transpose()).inverse();
      const double rounding = 1e-11 * expected.norm() * L.squaredNorm();
      EXPECT_EQ(inverse.pattern.row, factor.pattern.row);
      for (int i = 0; i < kBlocks; ++i)
        for (int j = 0; j < kBlocks; ++j) {
          const Eigen::MatrixXd block = inverse_block(inverse, size, i, j);
          const int column = std::min(i, j), row = std::max(i, j);
          const auto* const rows = factor.pattern.row.data();
          const bool in_pattern = std::count(rows + factor.pattern.start[column],
                                             rows + factor.pattern.start[column + 1], row) > 0;
          ASSERT_EQ(block.size(), in_pattern ? size * size : 0) << i << ", " << j;
          if (!in_pattern) continue;
          EXPECT_LT((block - expected.block(i * size, j * size, size, size)).norm(), rounding)
              << "size " << size << " density " << density << " block " << i << ", " << j;
          EXPECT_EQ(block, inverse_block(inverse, size, j, i).transpose());
        }
    }
}

TEST(SparseInverse, OfOneBlockIsItsInverseAndOfNothingNothing) {
  const BlockFactor factor{{{0, 1}, {0}}, {2, 1, 0, 4}};
  Eigen::Matrix2d matrix;  // L L^T of L = [2 0; 1 4]
  matrix << 4, 2, 2, 17;
  EXPECT_LT((inverse_block(sparse_inverse(factor, 2), 2, 0, 0) - matrix.inverse()).norm(), 1e-15);
  EXPECT_TRUE(sparse_inverse({{{0}, {}}, {}}, 3).values.empty());
}

TEST(BlockPanels, LieOneBehindTheOther) {
  BlockPanels panels;
  panels.block_size = 2;
  panels.pattern = {{0, 3, 4, 6}, {0, 1, 2, 1, 2, 3}};
  panels.values.resize(6 * 4);
  EXPECT_EQ(panels.pattern.count(), 3);
  const double* next = panels.values.data();
  for (const int rows : {6, 2, 4}) {
    const int column = rows == 6 ? 0 : rows == 2 ? 1 : 2;
    EXPECT_EQ(panels.rows(column), rows);
    EXPECT_EQ(panels.panel(column), next);
    next += rows * panels.block_size;
  }
  EXPECT_EQ(next, panels.values.data() + panels.values.size());
}

}  // namespace sparse_inverse_test
}  // namespace placegraph
