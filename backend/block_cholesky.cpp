#include <placegraph/backend/blas_threads.h>
#include <placegraph/backend/block_cholesky.h>
#include <placegraph/graph/core/error.h>
#include <suitesparse/cholmod.h>

#include <algorithm>
#include <limits>
#include <new>

namespace placegraph {
namespace {

/// Where a factor has fewer operations than this per entry, CHOLMOD's simplicial method is faster
/// than its supernodal one (measured: even at 80 to 100 on published pose graphs).
constexpr double kSupernodalSwitch = 90;
/// Nested dissection takes the time of some thousand operations for every block; it is tried where
/// the factorizations it could shorten take much longer.
constexpr double kOperationsPerBlockOfDissection = 20000;

/// CHOLMOD's workspace and settings, quiet.
class Workspace {
 public:
  Workspace() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.final_ll = 1;
    common_.nmethods = 1;
    common_.quick_return_if_not_posdef = 1;
  }
  ~Workspace() { cholmod_finish(&common_); }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
  cholmod_common* operator->() { return &common_; }
  operator cholmod_common*() { return &common_; }

 private:
  cholmod_common common_;
};

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
  Workspace common;
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
  Workspace common;
  int block_count, block_size;
  BlockOrdering ordering;
  cholmod_sparse* matrix = nullptr;  // lower part, block columns as dense panels
  cholmod_factor* factor = nullptr;
  cholmod_dense *rhs = nullptr, *x = nullptr, *work_y = nullptr, *work_e = nullptr;
  std::vector<int> block_start, block_row;  // the pattern by positions, the diagonal block first
  bool factorized = false;
  Eigen::VectorXd factorized_diagonal;  // of the matrix that was factorized, by positions

  Impl(int count, int size, const std::vector<std::pair<int, int>>& pairs, BlockOrdering order)
      : block_count(count), block_size(size), ordering(std::move(order)) {
    use_one_blas_thread();
    sort_pattern(pairs);
    allocate();
    analyze();
  }
  ~Impl() {
    cholmod_free_sparse(&matrix, common);
    cholmod_free_factor(&factor, common);
    for (cholmod_dense** dense : {&rhs, &x, &work_y, &work_e}) cholmod_free_dense(dense, common);
  }

  double* values() const { return static_cast<double*>(matrix->x); }
  int panel_rows(int column) const {
    return (block_start[column + 1] - block_start[column]) * block_size;
  }
  double* panel(int column) const {
    return values() + static_cast<std::ptrdiff_t>(block_start[column]) * block_size * block_size;
  }

  void sort_pattern(const std::vector<std::pair<int, int>>& pairs) {
    // Counting sort by row, then by column, leaves the rows of every column in order.
    std::vector<std::pair<int, int>> lower;  // column, row
    lower.reserve(pairs.size());
    for (const auto& [i, j] : pairs) {
      const int a = ordering.position[i], b = ordering.position[j];
      lower.emplace_back(std::min(a, b), std::max(a, b));
    }
    std::sort(lower.begin(), lower.end());
    lower.erase(std::unique(lower.begin(), lower.end()), lower.end());
    block_start.reserve(block_count + 1);
    block_row.reserve(lower.size() + block_count);
    std::size_t k = 0;
    for (int column = 0; column < block_count; ++column) {
      block_start.push_back(static_cast<int>(block_row.size()));
      block_row.push_back(column);
      for (; k < lower.size() && lower[k].first == column; ++k)
        block_row.push_back(lower[k].second);
    }
    block_start.push_back(static_cast<int>(block_row.size()));
  }

  void allocate() {
    const std::size_t size = static_cast<std::size_t>(block_count) * block_size;
    const std::size_t entries = block_row.size() * block_size * block_size;
    require(entries < static_cast<std::size_t>(std::numeric_limits<int>::max()),
            "BlockCholesky: the matrix is too large");
    matrix = cholmod_allocate_sparse(size, size, entries, 1, 1, -1, CHOLMOD_REAL, common);
    if (!matrix) throw std::bad_alloc();
    int* const start = static_cast<int*>(matrix->p);
    int* row = static_cast<int*>(matrix->i);
    for (int column = 0; column < block_count; ++column)
      for (int c = 0; c < block_size; ++c) {
        start[column * block_size + c] = static_cast<int>(row - static_cast<int*>(matrix->i));
        for (int k = block_start[column]; k < block_start[column + 1]; ++k)
          for (int r = 0; r < block_size; ++r) *row++ = block_row[k] * block_size + r;
      }
    start[size] = static_cast<int>(entries);
    std::fill_n(values(), entries, 0.0);
  }

  void analyze() {
    const double scale = block_size;
    common->supernodal = ordering.operations * scale < kSupernodalSwitch * ordering.fill
                             ? CHOLMOD_SIMPLICIAL
                             : CHOLMOD_SUPERNODAL;
    common->postorder = 0;  // the blocks are in postorder already
    common->method[0].ordering = CHOLMOD_NATURAL;
    if (common->supernodal == CHOLMOD_SUPERNODAL) {
      factor = cholmod_analyze(matrix, common);
    } else {
      // The counts of the scalar columns follow from those of the blocks.
      factor = cholmod_allocate_factor(static_cast<std::size_t>(block_count) * block_size, common);
      if (!factor) throw std::bad_alloc();
      int* count = static_cast<int*>(factor->ColCount);
      for (int column = 0; column < block_count; ++column)
        for (int c = 0; c < block_size; ++c)
          *count++ = ordering.column_count[column] * block_size - c;
    }
    if (!factor) throw std::bad_alloc();
  }

  double& diagonal_entry(int block, int c) const {
    const int column = ordering.position[block];
    return panel(column)[static_cast<std::ptrdiff_t>(c) * panel_rows(column) + c];
  }
  Eigen::VectorXd diagonal_by_position() const {
    Eigen::VectorXd diagonal(static_cast<Eigen::Index>(block_count) * block_size);
    for (int column = 0, i = 0; column < block_count; ++column)
      for (int c = 0; c < block_size; ++c, ++i)
        diagonal[i] = panel(column)[static_cast<std::ptrdiff_t>(c) * (panel_rows(column) + 1)];
    return diagonal;
  }
  void set_diagonal(const Eigen::VectorXd& diagonal) {
    for (int block = 0, i = 0; block < block_count; ++block)
      for (int c = 0; c < block_size; ++c, ++i) diagonal_entry(block, c) = diagonal[i];
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

int BlockCholesky::block_count() const { return impl_->block_count; }
int BlockCholesky::block_size() const { return impl_->block_size; }
const BlockOrdering& BlockCholesky::ordering() const { return impl_->ordering; }
bool BlockCholesky::has_factor() const { return impl_->factorized; }

BlockCholesky::Slot BlockCholesky::slot(int i, int j) const {
  const int a = impl_->ordering.position.at(i), b = impl_->ordering.position.at(j);
  const int column = std::min(a, b), row = std::max(a, b);
  const auto begin = impl_->block_row.begin() + impl_->block_start[column];
  const auto end = impl_->block_row.begin() + impl_->block_start[column + 1];
  const auto found = std::lower_bound(begin, end, row);
  require(found != end && *found == row, "BlockCholesky::slot: no such block in the pattern");
  return {impl_->panel(column) + (found - begin) * impl_->block_size, impl_->panel_rows(column),
          a < b};
}

void BlockCholesky::set_zero() { std::fill_n(impl_->values(), impl_->matrix->nzmax, 0.0); }

Eigen::VectorXd BlockCholesky::diagonal() const {
  const int size = impl_->block_size;
  Eigen::VectorXd diagonal(static_cast<Eigen::Index>(impl_->block_count) * size);
  for (int block = 0, i = 0; block < impl_->block_count; ++block)
    for (int c = 0; c < size; ++c, ++i) diagonal[i] = impl_->diagonal_entry(block, c);
  return diagonal;
}

void BlockCholesky::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& product) const {
  const int size = impl_->block_size;
  Eigen::VectorXd permuted(x.size());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(x.size());
  for (int block = 0; block < impl_->block_count; ++block)
    permuted.segment(impl_->ordering.position[block] * size, size) = x.segment(block * size, size);
  for (int column = 0; column < impl_->block_count; ++column) {
    const int rows = impl_->panel_rows(column);
    const double* entry = impl_->panel(column);
    const int* const block_row = &impl_->block_row[impl_->block_start[column]];
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
  for (int block = 0; block < impl_->block_count; ++block)
    product.segment(block * size, size) = sum.segment(impl_->ordering.position[block] * size, size);
}

bool BlockCholesky::factorize(const Eigen::VectorXd& damping) {
  Eigen::VectorXd undamped;
  if (damping.size()) {
    undamped = diagonal();
    impl_->set_diagonal(undamped + damping);
  }
  impl_->factorized_diagonal = impl_->diagonal_by_position();
  cholmod_factorize(impl_->matrix, impl_->factor, impl_->common);
  if (damping.size()) impl_->set_diagonal(undamped);
  if (impl_->common->status < CHOLMOD_OK) {
    const int status = impl_->common->status;
    impl_->factorized = false;
    if (status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    throw ArgumentError("BlockCholesky: CHOLMOD failed with status " + std::to_string(status));
  }
  impl_->factorized =
      impl_->common->status == CHOLMOD_OK && impl_->factor->minor == impl_->factor->n;
  return impl_->factorized;
}

double BlockCholesky::smallest_pivot() const {
  require(impl_->factorized, "BlockCholesky::smallest_pivot: there is no factor");
  const cholmod_factor& factor = *impl_->factor;
  const double* const value = static_cast<const double*>(factor.x);
  const Eigen::VectorXd& diagonal = impl_->factorized_diagonal;
  double smallest = std::numeric_limits<double>::infinity();
  const auto see = [&](std::size_t column, double pivot) {
    smallest = std::min(smallest, pivot * pivot / diagonal[static_cast<Eigen::Index>(column)]);
  };
  if (factor.is_super) {
    const int* const super = static_cast<const int*>(factor.super);
    const int* const first_row = static_cast<const int*>(factor.pi);
    const int* const first_value = static_cast<const int*>(factor.px);
    for (std::size_t s = 0; s < factor.nsuper; ++s) {
      const std::ptrdiff_t rows = first_row[s + 1] - first_row[s];
      for (int c = super[s]; c < super[s + 1]; ++c)
        see(c, value[first_value[s] + (c - super[s]) * (rows + 1)]);
    }
  } else {
    const int* const start = static_cast<const int*>(factor.p);
    for (std::size_t column = 0; column < factor.n; ++column) see(column, value[start[column]]);
  }
  return smallest;
}

void BlockCholesky::solve(Eigen::Ref<Eigen::MatrixXd> b) {
  require(impl_->factorized, "BlockCholesky::solve: there is no factor");
  const int size = impl_->block_size;
  const std::size_t rows = static_cast<std::size_t>(b.rows()),
                    columns = static_cast<std::size_t>(b.cols());
  cholmod_dense*& rhs = impl_->rhs;
  if (!rhs || rhs->ncol != columns) {
    cholmod_free_dense(&rhs, impl_->common);
    rhs = cholmod_allocate_dense(rows, columns, rows, CHOLMOD_REAL, impl_->common);
    if (!rhs) throw std::bad_alloc();
  }
  Eigen::Map<Eigen::MatrixXd> permuted(static_cast<double*>(rhs->x), b.rows(), b.cols());
  for (int block = 0; block < impl_->block_count; ++block)
    permuted.middleRows(impl_->ordering.position[block] * size, size) =
        b.middleRows(block * size, size);
  if (!cholmod_solve2(CHOLMOD_A, impl_->factor, rhs, nullptr, &impl_->x, nullptr, &impl_->work_y,
                      &impl_->work_e, impl_->common))
    throw std::bad_alloc();
  const Eigen::Map<const Eigen::MatrixXd> x(static_cast<const double*>(impl_->x->x), b.rows(),
                                            b.cols());
  for (int block = 0; block < impl_->block_count; ++block)
    b.middleRows(block * size, size) = x.middleRows(impl_->ordering.position[block] * size, size);
}

double BlockCholesky::factor_size() const {
  return impl_->ordering.fill * impl_->block_size * impl_->block_size;
}

double BlockCholesky::solves_per_factorization() const {
  // A factorization runs its operations several times as fast as a solve, which waits for memory.
  const double operations = impl_->ordering.operations * impl_->block_size;
  const double speed = impl_->factor->is_super ? 10 : 2;
  return std::max(1.0, operations / (speed * impl_->ordering.fill));
}

BlockCholesky::LowerFactor BlockCholesky::lower_factor() const {
  require(impl_->factorized, "BlockCholesky::lower_factor: there is no factor");
  // A copy in simplicial form: scalar columns, rows in order.
  cholmod_common* common = impl_->common;
  cholmod_factor* copy = cholmod_copy_factor(impl_->factor, common);
  if (!copy || !cholmod_change_factor(CHOLMOD_REAL, 1, 0, 1, 1, copy, common))
    throw std::bad_alloc();
  const int* const start = static_cast<const int*>(copy->p);
  const int* const row = static_cast<const int*>(copy->i);
  const int* const count = static_cast<const int*>(copy->nz);
  const double* const value = static_cast<const double*>(copy->x);
  const int size = impl_->block_size, square = size * size;
  LowerFactor lower;
  std::vector<int> place(impl_->block_count, -1);
  for (int column = 0; column < impl_->block_count; ++column) {
    lower.start.push_back(static_cast<int>(lower.row.size()));
    // All columns of a block share its rows, but for entries that are zero by coincidence of
    // pattern; the first column has them all.
    for (int c = 0; c < size; ++c)
      for (int k = start[column * size + c];
           k < start[column * size + c] + count[column * size + c]; ++k)
        if (place[row[k] / size] < lower.start.back()) {
          place[row[k] / size] = static_cast<int>(lower.row.size());
          lower.row.push_back(row[k] / size);
        }
    std::sort(lower.row.begin() + lower.start.back(), lower.row.end());
    for (std::size_t k = lower.start.back(); k < lower.row.size(); ++k)
      place[lower.row[k]] = static_cast<int>(k);
    lower.values.resize(lower.row.size() * square, 0.0);
    for (int c = 0; c < size; ++c)
      for (int k = start[column * size + c];
           k < start[column * size + c] + count[column * size + c]; ++k)
        lower.values[static_cast<std::size_t>(place[row[k] / size]) * square + c * size +
                     row[k] % size] = value[k];
  }
  lower.start.push_back(static_cast<int>(lower.row.size()));
  cholmod_free_factor(&copy, common);
  return lower;
}

}  // namespace placegraph
