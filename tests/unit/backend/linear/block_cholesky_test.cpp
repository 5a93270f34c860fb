#include <gmock/gmock.h>
#include <placegraph/backend/linear/block_cholesky.h>
#include <placegraph/backend/linear/fill_factor.h>
#include <placegraph/backend/linear/simplicial_factor.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>

#include "tests/support/seed.h"

namespace placegraph {
namespace block_cholesky_test {

using Pairs = std::vector<std::pair<int, int>>;

/// A chain of blocks with shortcuts.
Pairs chain_with_shortcuts(int blocks, int shortcuts, Random& random) {
  Pairs pairs;
  for (int i = 0; i + 1 < blocks; ++i) pairs.emplace_back(i, i + 1);
  while (shortcuts > 0) {
    const int i = static_cast<int>(random.uniform() * blocks);
    const int j = static_cast<int>(random.uniform() * blocks);
    if (i == j) continue;
    pairs.emplace_back(i, j);
    --shortcuts;
  }
  return pairs;
}

Eigen::MatrixXd random_matrix(int rows, int columns, Random& random) {
  Eigen::MatrixXd matrix(rows, columns);
  for (Eigen::Index i = 0; i < matrix.size(); ++i) matrix.data()[i] = random.normal();
  return matrix;
}

/// J^T J of random blocks for every pair plus the identity, dense.
Eigen::MatrixXd random_spd(int blocks, int size, const Pairs& pairs, Random& random) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Identity(blocks * size, blocks * size);
  for (const auto& [i, j] : pairs) {
    const Eigen::MatrixXd A = random_matrix(size, size, random),
                          B = random_matrix(size, size, random);
    dense.block(i * size, i * size, size, size) += A.transpose() * A;
    dense.block(j * size, j * size, size, size) += B.transpose() * B;
    dense.block(i * size, j * size, size, size) += A.transpose() * B;
    dense.block(j * size, i * size, size, size) += B.transpose() * A;
  }
  return dense;
}

void set_block(const BlockCholesky::Slot& slot, const Eigen::MatrixXd& block) {
  Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>(slot.first, block.rows(), block.cols(),
                                                       Eigen::OuterStride<>(slot.stride)) =
      slot.transposed ? Eigen::MatrixXd(block.transpose()) : block;
}

void fill(BlockCholesky& matrix, const Eigen::MatrixXd& dense, const Pairs& pairs) {
  const int size = matrix.block_size();
  for (int i = 0; i < matrix.block_count(); ++i)
    set_block(matrix.slot(i, i), dense.block(i * size, i * size, size, size));
  for (const auto& [i, j] : pairs)
    set_block(matrix.slot(i, j), dense.block(i * size, j * size, size, size));
}

Eigen::MatrixXd dense_factor(const BlockFactor& factor, int size) {
  const int blocks = factor.pattern.count();
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(blocks * size, blocks * size);
  for (int j = 0; j < blocks; ++j)
    for (int k = factor.pattern.start[j]; k < factor.pattern.start[j + 1]; ++k)
      L.block(factor.pattern.row[k] * size, j * size, size, size) =
          Eigen::Map<const Eigen::MatrixXd>(&factor.values[k * size * size], size, size);
  return L;
}

class BlockCholeskyOfSize : public testing::TestWithParam<int> {};

TEST_P(BlockCholeskyOfSize, SolvesMultipliesAndDampsAsTheDenseMatrixDoes) {
  Random random = test::seeded_random(11);
  const int size = GetParam(), blocks = 23;
  const Pairs pairs = chain_with_shortcuts(blocks, 12, random);
  const Eigen::MatrixXd dense = random_spd(blocks, size, pairs, random);
  BlockCholesky matrix(blocks, size, pairs);
  fill(matrix, dense, pairs);
  const Eigen::MatrixXd b = random_matrix(blocks * size, 3, random);

  Eigen::VectorXd product;
  matrix.multiply(b.col(0), product);
  EXPECT_LT((product - dense * b.col(0)).norm(), 1e-11 * dense.norm());
  EXPECT_LT((matrix.diagonal() - dense.diagonal()).norm(), 1e-13 * dense.norm());

  ASSERT_TRUE(matrix.factorize());
  Eigen::MatrixXd x = b;
  matrix.solve(x);
  EXPECT_LT((dense * x - b).norm(), 1e-10 * dense.norm());

  const Eigen::VectorXd damping = Eigen::VectorXd::LinSpaced(blocks * size, 1, 5);
  ASSERT_TRUE(matrix.factorize(damping));
  x = b;
  matrix.solve(x);
  EXPECT_LT((dense * x + damping.asDiagonal() * x - b).norm(), 1e-10 * dense.norm());
  EXPECT_LT((matrix.diagonal() - dense.diagonal()).norm(), 1e-13 * dense.norm());
}

TEST_P(BlockCholeskyOfSize, HandsOutAFactorWhoseSquareIsTheMatrix) {
  Random random = test::seeded_random(12);
  const int size = GetParam(), blocks = 15;
  const Pairs pairs = chain_with_shortcuts(blocks, 6, random);
  const Eigen::MatrixXd dense = random_spd(blocks, size, pairs, random);
  BlockCholesky matrix(blocks, size, pairs);
  fill(matrix, dense, pairs);
  ASSERT_TRUE(matrix.factorize());
  const Eigen::MatrixXd L = dense_factor(matrix.factor(), size);
  EXPECT_EQ(L.triangularView<Eigen::StrictlyUpper>().toDenseMatrix().norm(), 0);
  const Eigen::MatrixXd square = L * L.transpose();
  for (int i = 0; i < blocks; ++i)
    for (int j = 0; j < blocks; ++j) {
      const int a = matrix.ordering().position[i], b = matrix.ordering().position[j];
      EXPECT_LT((square.block(a * size, b * size, size, size) -
                 dense.block(i * size, j * size, size, size))
                    .norm(),
                1e-11 * dense.norm());
    }
}

/// What `make` factorizes says what the factorization by blocks does.
void expect_the_same(std::unique_ptr<FillFactor> (*make)(const BlockPanels&),
                     const BlockPanels& matrix, const Eigen::MatrixXd& rhs) {
  SimplicialFactor simplicial(matrix);
  const std::unique_ptr<FillFactor> filled = make(matrix);
  FillFactor& other = *filled;
  ASSERT_TRUE(simplicial.factorize(matrix));
  ASSERT_TRUE(other.factorize());
  EXPECT_LT((simplicial.pivots() - other.pivots()).norm(), 1e-12 * simplicial.pivots().norm());
  const Eigen::MatrixXd L = dense_factor(simplicial.blocks(), matrix.block_size);
  EXPECT_LT((dense_factor(other.blocks(), matrix.block_size) - L).norm(), 1e-12 * L.norm());
  Eigen::MatrixXd x = rhs, y = rhs;
  simplicial.solve(x);
  other.solve(y);
  EXPECT_LT((x - y).norm(), 1e-12 * x.norm());

  BlockPanels indefinite = matrix;
  SimplicialFactor by_blocks(indefinite);
  const std::unique_ptr<FillFactor> by_other = make(indefinite);
  indefinite.panel(7)[0] = -1;
  EXPECT_FALSE(by_blocks.factorize(indefinite));
  EXPECT_FALSE(by_other->factorize());
}

/// The same matrix through all factorizations.
TEST_P(BlockCholeskyOfSize, FactorizesByBlocksAsByScalarsAndSupernodes) {
  Random random = test::seeded_random(13);
  const int size = GetParam(), blocks = 20;
  BlockPanels matrix;
  matrix.block_size = size;
  // A band of width 4 stands in postorder as it is.
  for (int j = 0; j < blocks; ++j) {
    matrix.pattern.start.push_back(static_cast<int>(matrix.pattern.row.size()));
    for (int i = j; i < std::min(j + 4, blocks); ++i) matrix.pattern.row.push_back(i);
  }
  matrix.pattern.start.push_back(static_cast<int>(matrix.pattern.row.size()));
  matrix.values.resize(matrix.pattern.row.size() * size * size);
  for (double& value : matrix.values) value = 0.3 * random.normal();
  for (int j = 0; j < blocks; ++j)
    for (int c = 0; c < size; ++c) matrix.panel(j)[c * (matrix.rows(j) + 1)] = 8 * size;
  const Eigen::MatrixXd rhs = random_matrix(blocks * size, 2, random);
  expect_the_same(scalar_factor, matrix, rhs);
#if PLACEGRAPH_GPL
  expect_the_same(supernodal_factor, matrix, rhs);
#endif
}

INSTANTIATE_TEST_SUITE_P(Sizes, BlockCholeskyOfSize, testing::Values(1, 2, 3, 6, 7));

TEST(BlockCholesky, SaysWhereAMatrixIsSingularOrIndefinite) {
  const Pairs pairs = {{0, 1}, {1, 2}, {2, 0}, {0, 1}};
  BlockCholesky matrix(3, 1, pairs);
  Eigen::Matrix3d laplacian;
  laplacian << 2, -1, -1, -1, 2, -1, -1, -1, 2;
  fill(matrix, laplacian + 0.5 * Eigen::Matrix3d::Identity(), pairs);
  ASSERT_TRUE(matrix.factorize());
  EXPECT_GT(matrix.smallest_pivot(), 0.1);
  // A triangle that nothing ties down: pivots at rounding or below.
  fill(matrix, laplacian + 1e-15 * Eigen::Matrix3d::Identity(), pairs);
  EXPECT_TRUE(!matrix.factorize() || matrix.smallest_pivot() < 1e-12);
  fill(matrix, laplacian - 2.5 * Eigen::Matrix3d::Identity(), pairs);
  EXPECT_FALSE(matrix.factorize());
  EXPECT_FALSE(matrix.has_factor());
  Eigen::VectorXd x = Eigen::VectorXd::Ones(3);
  EXPECT_THROW(matrix.solve(x), Error);
  EXPECT_THROW((void)BlockCholesky(4, 1, pairs).slot(0, 3), Error);
}

TEST(BlockOrdering, IsAPermutationAndPredictsTheFillOfAChain) {
  Pairs pairs;
  for (int i = 0; i < 40; ++i) pairs.emplace_back(i + 1, i);
  const BlockOrdering ordering = order_blocks(41, 3, pairs);
  std::vector<int> sorted = ordering.position;
  std::sort(sorted.begin(), sorted.end());
  for (int i = 0; i < 41; ++i) EXPECT_EQ(sorted[i], i);
  EXPECT_EQ(ordering.fill, 81);  // a chain fills in nothing
  EXPECT_TRUE(order_blocks(0, 3, {}).position.empty());
}

}  // namespace block_cholesky_test
}  // namespace placegraph
