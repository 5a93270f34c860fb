#pragma once
#include <placegraph/backend/internal/linear/block_columns.h>

#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

namespace placegraph {

/// In which order the blocks of a symmetric block-sparse matrix are eliminated, and what that will
/// cost. Computed on the graph of blocks, not of scalars: approximate minimum degree first, nested
/// dissection (METIS) beside it where the elimination is so heavy that a better order pays for the
/// search; the one with fewer predicted operations is taken.
struct BlockOrdering {
  std::vector<int> position;      ///< of every block in the order of elimination
  std::vector<int> column_count;  ///< blocks in each column of the factor, by position
  double operations = 0;          ///< multiplications of a factorization with blocks of size one
  double fill = 0;                ///< blocks in the factor
};

/// `pairs` are the off-diagonal blocks that are not zero, each in either order, repeats allowed;
/// `block_size` weighs the search for an order against what it saves.
BlockOrdering order_blocks(int block_count, int block_size,
                           const std::vector<std::pair<int, int>>& pairs);

/// A symmetric positive definite matrix of square blocks, assembled block by block straight into
/// the form that is factorized, and its Cholesky factor: CHOLMOD's supernodal one where the fill is
/// dense enough for BLAS, our block-wise one where it is thin. Ordering and symbolic analysis
/// happen once, in the constructor; every factorization is numeric only. The same input gives the
/// same bits.
///
/// The native solver, which rests on it, takes 1.8 to 6.2 times less CPU than Ceres with CHOLMOD on
/// the graphs of docs/results.md (pose graphs): 21 ms against 60 for M3500, 117 against 385 for
/// city10000.
class BlockCholesky {
 public:
  BlockCholesky(int block_count, int block_size, const std::vector<std::pair<int, int>>& pairs);
  /// With an ordering of the same blocks and pairs (it serves matrices of any block size).
  BlockCholesky(int block_count, int block_size, const std::vector<std::pair<int, int>>& pairs,
                const BlockOrdering& ordering);
  ~BlockCholesky();
  BlockCholesky(BlockCholesky&&) noexcept;
  BlockCholesky& operator=(BlockCholesky&&) noexcept;

  int block_count() const;
  int block_size() const;
  const BlockOrdering& ordering() const;

  /// Where block (i, j) is kept: column-major at `first`, columns `stride` doubles apart. What is
  /// kept is the block (i, j), or the block (j, i) if `transposed`.
  struct Slot {
    double* first = nullptr;
    Eigen::Index stride = 0;
    bool transposed = false;
  };
  /// The slot of a diagonal block (all of it is kept; the part below the diagonal counts) or of one
  /// of `pairs`. Slots stay where they are as long as the matrix lives.
  Slot slot(int i, int j) const;

  void set_zero();
  /// Diagonal of the matrix, by blocks: block_count * block_size.
  Eigen::VectorXd diagonal() const;
  /// matrix * x; x by blocks.
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& product) const;

  /// Factorizes matrix + diag(damping) (by blocks; empty: none); the matrix stays as it is. False
  /// if that is not positive definite (to rounding): there is no factor then.
  [[nodiscard]] bool factorize(const Eigen::VectorXd& damping = {});
  bool has_factor() const;
  /// The smallest pivot of the last factorization as a share of its diagonal entry: near rounding
  /// where the matrix is singular.
  double smallest_pivot() const;
  /// Solves with the last factor, column by column of `b` (by blocks), in place.
  void solve(Eigen::Ref<Eigen::MatrixXd> b) const;
  /// Doubles in the factor, and operations of one solve against one factorization.
  double factor_size() const;
  double solves_per_factorization() const;

  /// The factor by blocks in the order of elimination (BlockOrdering::position).
  BlockFactor factor() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace placegraph
