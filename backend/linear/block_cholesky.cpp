#include <placegraph/backend/linear/blas_threads.h>
#include <placegraph/backend/linear/block_cholesky.h>
#include <placegraph/backend/linear/cholmod_workspace.h>
#include <placegraph/backend/linear/fill_factor.h>
#include <placegraph/backend/linear/simplicial_factor.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>

#include <algorithm>
#include <memory>
#include <new>
#include <optional>

namespace placegraph {
namespace {

std::unique_ptr<FillFactor> factor_for_much_fill(const BlockPanels& matrix) {
#if PLACEGRAPH_GPL
  return supernodal_factor(matrix);
#else
  return scalar_factor(matrix);
#endif
}

/// If a factor has fewer operations per entry, the block-wise kernels are faster than BLAS on
/// supernodes (measured on published pose graphs, of which the heaviest has 320).
constexpr double kSupernodalSwitch = 400;
/// Nested dissection costs about as much time as this many operations for every block, counted over
/// the factorizations that its better order can shorten.
constexpr double kOperationsPerBlockOfDissection = 50000;

/// The pattern of the blocks as CHOLMOD's symmetric matrix (upper part), repeats merged.
cholmod_sparse* block_pattern(int block_count, const std::vector<std::pair<int, int>>& pairs,
                              cholmod_common* common) {
  const std::size_t count = static_cast<std::size_t>(block_count) + pairs.size();
  cholmod_triplet* entries =
      cholmod_allocate_triplet(block_count, block_count, count, 1, CHOLMOD_PATTERN, common);
  if (!entries) throw std::bad_alloc();
  int* const row = static_cast<int*>(entries->i);
  int* const column = static_cast<int*>(entries->j);
  std::size_t k = 0;
  for (int i = 0; i < block_count; ++i, ++k) row[k] = column[k] = i;
  for (const auto& [i, j] : pairs) {
    row[k] = std::min(i, j);
    column[k++] = std::max(i, j);
  }
  entries->nnz = count;
  cholmod_sparse* pattern = cholmod_triplet_to_sparse(entries, count, common);
  cholmod_free_triplet(&entries, common);
  if (!pattern) throw std::bad_alloc();
  return pattern;
}

}  // namespace

BlockOrdering order_blocks(int block_count, int block_size,
                           const std::vector<std::pair<int, int>>& pairs) {
  BlockOrdering best;
  if (block_count == 0) return best;
  CholmodWorkspace common;
  common->supernodal = CHOLMOD_SIMPLICIAL;
  cholmod_sparse* pattern = block_pattern(block_count, pairs, common);
  const double scale = static_cast<double>(block_size) * block_size * block_size;
  for (const int method : {CHOLMOD_AMD, CHOLMOD_METIS}) {
    if (method == CHOLMOD_METIS &&
        best.operations * scale < kOperationsPerBlockOfDissection * block_count)
      break;
    common->method[0].ordering = method;
    cholmod_factor* factor = cholmod_analyze(pattern, common);
    if (!factor) continue;
    if (best.position.empty() || common->fl < best.operations) {
      const int* const permutation = static_cast<const int*>(factor->Perm);
      const int* const column_count = static_cast<const int*>(factor->ColCount);
      best.position.resize(block_count);
      for (int k = 0; k < block_count; ++k) best.position[permutation[k]] = k;
      best.column_count.assign(column_count, column_count + block_count);
      best.operations = common->fl;
      best.fill = common->lnz;
    }
    cholmod_free_factor(&factor, common);
  }
  cholmod_free_sparse(&pattern, common);
  if (best.position.empty()) throw std::bad_alloc();
  return best;
}

struct BlockCholesky::Impl {
  BlockOrdering ordering;
  BlockPanels matrix;
  std::optional<SimplicialFactor> simplicial;  // exactly one of the two is set
  std::unique_ptr<FillFactor> filled;
  bool factorized = false;
  Eigen::VectorXd factorized_diagonal;  // diagonal of the factorized matrix, by positions

  Impl(int count, int size, const std::vector<std::pair<int, int>>& pairs, BlockOrdering order)
      : ordering(std::move(order)) {
    use_one_blas_thread();
    matrix.block_size = size;
    matrix.pattern = sorted_pattern(count, pairs);
    matrix.values.resize(matrix.pattern.row.size() * size * size);
    if (SimplicialFactor::has_kernel(size) &&
        (!PLACEGRAPH_GPL || ordering.operations * size <= kSupernodalSwitch * ordering.fill))
      simplicial.emplace(matrix);
    else
      filled = factor_for_much_fill(matrix);
  }

  BlockColumns sorted_pattern(int count, const std::vector<std::pair<int, int>>& pairs) const {
    std::vector<std::pair<int, int>> lower;  // column, row
    lower.reserve(pairs.size());
    for (const auto& [i, j] : pairs) {
      const int a = ordering.position[i], b = ordering.position[j];
      lower.emplace_back(std::min(a, b), std::max(a, b));
    }
    std::sort(lower.begin(), lower.end());
    lower.erase(std::unique(lower.begin(), lower.end()), lower.end());
    BlockColumns pattern;
    pattern.start.reserve(count + 1);
    pattern.row.reserve(lower.size() + count);
    std::size_t k = 0;
    for (int column = 0; column < count; ++column) {
      pattern.start.push_back(static_cast<int>(pattern.row.size()));
      pattern.row.push_back(column);
      for (; k < lower.size() && lower[k].first == column; ++k)
        pattern.row.push_back(lower[k].second);
    }
    pattern.start.push_back(static_cast<int>(pattern.row.size()));
    return pattern;
  }

  double& diagonal_entry(int column, int c) {
    return matrix.panel(column)[static_cast<std::ptrdiff_t>(c) * (matrix.rows(column) + 1)];
  }
  Eigen::VectorXd diagonal_by_position() {
    const int size = matrix.block_size, count = matrix.pattern.count();
    Eigen::VectorXd diagonal(static_cast<Eigen::Index>(count) * size);
    for (int column = 0, i = 0; column < count; ++column)
      for (int c = 0; c < size; ++c, ++i) diagonal[i] = diagonal_entry(column, c);
    return diagonal;
  }
  void set_diagonal_by_position(const Eigen::VectorXd& diagonal) {
    const int size = matrix.block_size, count = matrix.pattern.count();
    for (int column = 0, i = 0; column < count; ++column)
      for (int c = 0; c < size; ++c, ++i) diagonal_entry(column, c) = diagonal[i];
  }
  /// Reorders rows of blocks from the caller's numbering to the order of elimination, and back.
  Eigen::MatrixXd to_positions(const Eigen::Ref<const Eigen::MatrixXd>& x) const {
    const int size = matrix.block_size, count = matrix.pattern.count();
    Eigen::MatrixXd permuted(x.rows(), x.cols());
    for (int block = 0; block < count; ++block)
      permuted.middleRows(ordering.position[block] * size, size) = x.middleRows(block * size, size);
    return permuted;
  }
  void from_positions(const Eigen::Ref<const Eigen::MatrixXd>& permuted,
                      Eigen::Ref<Eigen::MatrixXd> x) const {
    const int size = matrix.block_size, count = matrix.pattern.count();
    for (int block = 0; block < count; ++block)
      x.middleRows(block * size, size) = permuted.middleRows(ordering.position[block] * size, size);
  }
};

BlockCholesky::BlockCholesky(int block_count, int block_size,
                             const std::vector<std::pair<int, int>>& pairs)
    : BlockCholesky(block_count, block_size, pairs, order_blocks(block_count, block_size, pairs)) {}

BlockCholesky::BlockCholesky(int block_count, int block_size,
                             const std::vector<std::pair<int, int>>& pairs,
                             const BlockOrdering& ordering)
    : impl_(std::make_unique<Impl>(block_count, block_size, pairs, ordering)) {}

BlockCholesky::~BlockCholesky() = default;
BlockCholesky::BlockCholesky(BlockCholesky&&) noexcept = default;
BlockCholesky& BlockCholesky::operator=(BlockCholesky&&) noexcept = default;

int BlockCholesky::block_count() const { return impl_->matrix.pattern.count(); }
int BlockCholesky::block_size() const { return impl_->matrix.block_size; }
const BlockOrdering& BlockCholesky::ordering() const { return impl_->ordering; }
bool BlockCholesky::has_factor() const { return impl_->factorized; }

BlockCholesky::Slot BlockCholesky::slot(int i, int j) const {
  const int a = impl_->ordering.position.at(i), b = impl_->ordering.position.at(j);
  const int column = std::min(a, b), row = std::max(a, b);
  const BlockColumns& pattern = impl_->matrix.pattern;
  const auto begin = pattern.row.begin() + pattern.start[column];
  const auto end = pattern.row.begin() + pattern.start[column + 1];
  const auto found = std::lower_bound(begin, end, row);
  require(found != end && *found == row, "BlockCholesky::slot: no such block in the pattern");
  return {impl_->matrix.panel(column) + (found - begin) * block_size(), impl_->matrix.rows(column),
          a < b};
}

void BlockCholesky::set_zero() {
  std::fill(impl_->matrix.values.begin(), impl_->matrix.values.end(), 0.0);
}

Eigen::VectorXd BlockCholesky::diagonal() const {
  const Eigen::VectorXd permuted = impl_->diagonal_by_position();
  Eigen::VectorXd diagonal(permuted.size());
  impl_->from_positions(permuted, diagonal);
  return diagonal;
}

void BlockCholesky::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& product) const {
  const int size = block_size();
  const Eigen::VectorXd permuted = impl_->to_positions(x);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(x.size());
  for (int column = 0; column < block_count(); ++column) {
    const int rows = impl_->matrix.rows(column);
    const double* entry = impl_->matrix.panel(column);
    const int* const block_row = &impl_->matrix.pattern.row[impl_->matrix.pattern.start[column]];
    for (int c = 0; c < size; ++c, entry += rows) {
      const Eigen::Index j = static_cast<Eigen::Index>(column) * size + c;
      const double x_j = permuted[j];
      double sum_j = entry[c] * x_j;
      for (int r = c + 1; r < size; ++r) {
        sum_j += entry[r] * permuted[j - c + r];
        sum[j - c + r] += entry[r] * x_j;
      }
      for (int k = size; k < rows; k += size) {
        const double* const x_i = &permuted[static_cast<Eigen::Index>(block_row[k / size]) * size];
        double* const sum_i = &sum[static_cast<Eigen::Index>(block_row[k / size]) * size];
        for (int r = 0; r < size; ++r) {
          sum_j += entry[k + r] * x_i[r];
          sum_i[r] += entry[k + r] * x_j;
        }
      }
      sum[j] += sum_j;
    }
  }
  product.resize(x.size());
  impl_->from_positions(sum, product);
}

bool BlockCholesky::factorize(const Eigen::VectorXd& damping) {
  check_interruption();
  const Eigen::VectorXd undamped = impl_->diagonal_by_position();
  impl_->factorized_diagonal = undamped;
  if (damping.size()) {
    impl_->factorized_diagonal += impl_->to_positions(damping);
    impl_->set_diagonal_by_position(impl_->factorized_diagonal);
  }
  impl_->factorized =
      impl_->simplicial ? impl_->simplicial->factorize(impl_->matrix) : impl_->filled->factorize();
  if (damping.size()) impl_->set_diagonal_by_position(undamped);
  return impl_->factorized;
}

double BlockCholesky::smallest_pivot() const {
  require(impl_->factorized, "BlockCholesky::smallest_pivot: there is no factor");
  const Eigen::VectorXd pivots =
      impl_->simplicial ? impl_->simplicial->pivots() : impl_->filled->pivots();
  if (pivots.size() == 0) return 1;
  return pivots.cwiseAbs2().cwiseQuotient(impl_->factorized_diagonal).minCoeff();
}

void BlockCholesky::solve(Eigen::Ref<Eigen::MatrixXd> b) const {
  check_interruption();
  require(impl_->factorized, "BlockCholesky::solve: there is no factor");
  Eigen::MatrixXd permuted = impl_->to_positions(b);
  if (impl_->simplicial)
    impl_->simplicial->solve(permuted);
  else
    impl_->filled->solve(permuted);
  impl_->from_positions(permuted, b);
}

double BlockCholesky::factor_size() const {
  return impl_->ordering.fill * block_size() * block_size();
}

double BlockCholesky::solves_per_factorization() const {
  // A factorization runs its operations several times as fast as a solve, which waits for memory.
  const double operations = impl_->ordering.operations * block_size();
  const double speed = impl_->filled ? 10 : 3 * block_size();  // measured
  return std::max(1.0, operations / (speed * impl_->ordering.fill));
}

BlockFactor BlockCholesky::factor() const {
  require(impl_->factorized, "BlockCholesky::factor: there is no factor");
  return impl_->simplicial ? impl_->simplicial->blocks() : impl_->filled->blocks();
}

}  // namespace placegraph
