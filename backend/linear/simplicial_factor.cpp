#include <placegraph/backend/linear/simplicial_factor.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/function_clones.h>
#include <placegraph/graph/core/parallel.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Rows of every column of the factor (George & Liu 1981): those of the matrix, and those below
/// the diagonal of every column whose first row below it is this one.
BlockColumns fill_in(const BlockColumns& matrix) {
  const int count = matrix.count();
  BlockColumns factor;
  factor.start.reserve(count + 1);
  factor.row.reserve(2 * matrix.row.size());
  std::vector<int> seen(count, -1), first_child(count, -1), next_sibling(count, -1);
  for (int j = 0; j < count; ++j) {
    const std::size_t begin = factor.row.size();
    factor.start.push_back(static_cast<int>(begin));
    const auto add = [&](int row) {
      if (row < j || seen[row] == j) return;
      seen[row] = j;
      factor.row.push_back(row);
    };
    for (int k = matrix.start[j]; k < matrix.start[j + 1]; ++k) add(matrix.row[k]);
    for (int child = first_child[j]; child >= 0; child = next_sibling[child])
      for (int k = factor.start[child] + 1; k < factor.start[child + 1]; ++k) add(factor.row[k]);
    std::sort(factor.row.begin() + static_cast<std::ptrdiff_t>(begin), factor.row.end());
    if (factor.row.size() > begin + 1) {
      const int parent = factor.row[begin + 1];
      next_sibling[j] = first_child[parent];
      first_child[parent] = j;
    }
  }
  factor.start.push_back(static_cast<int>(factor.row.size()));
  return factor;
}

/// C -= A B^T
template <int b>
PLACEGRAPH_INLINE void subtract_product(double* __restrict C, const double* __restrict A,
                                        const double* __restrict B) {
  for (int c = 0; c < b; ++c)
    for (int k = 0; k < b; ++k) {
      const double scale = B[k * b + c];
      for (int r = 0; r < b; ++r) C[c * b + r] -= A[k * b + r] * scale;
    }
}

/// The Cholesky factor of a block in its lower part, zeros above; false if not positive definite.
template <int b>
PLACEGRAPH_INLINE bool factorize_diagonal(double* A) {
  for (int c = 0; c < b; ++c) {
    double pivot = A[c * b + c];
    for (int k = 0; k < c; ++k) pivot -= A[k * b + c] * A[k * b + c];
    if (!(pivot > 0)) return false;
    A[c * b + c] = std::sqrt(pivot);
    const double inverse = 1 / A[c * b + c];
    for (int r = c + 1; r < b; ++r) {
      double sum = A[c * b + r];
      for (int k = 0; k < c; ++k) sum -= A[k * b + r] * A[k * b + c];
      A[c * b + r] = sum * inverse;
    }
    for (int r = 0; r < c; ++r) A[c * b + r] = 0;
  }
  return true;
}

/// X L^T = A in place
template <int b>
PLACEGRAPH_INLINE void divide_by_transpose(double* __restrict A, const double* __restrict L) {
  for (int c = 0; c < b; ++c) {
    for (int k = 0; k < c; ++k)
      for (int r = 0; r < b; ++r) A[c * b + r] -= A[k * b + r] * L[k * b + c];
    const double inverse = 1 / L[c * b + c];
    for (int r = 0; r < b; ++r) A[c * b + r] *= inverse;
  }
}

struct Work {
  const BlockPanels& matrix;
  const BlockColumns& factor;
  double* values;
  int* place;       ///< position of a row's block in the current column
  int* list;        ///< for every row: the first finished column whose next block is there
  int* link;        ///< next column in the same list
  int* next_block;  ///< next block of every finished column
};

template <int b>
PLACEGRAPH_INLINE bool factorize_blocks(const Work& work) {
  constexpr int square = b * b;
  const int count = work.factor.count();
  const int* const row = work.factor.row.data();
  int* const list = work.list;
  int* const link = work.link;
  std::fill_n(list, count, -1);
  for (int j = 0; j < count; ++j) {
    const int begin = work.factor.start[j], end = work.factor.start[j + 1];
    double* const column = work.values + static_cast<std::ptrdiff_t>(begin) * square;
    for (int k = begin; k < end; ++k) work.place[row[k]] = (k - begin) * square;
    std::fill_n(column, static_cast<std::ptrdiff_t>(end - begin) * square, 0.0);
    const BlockColumns& pattern = work.matrix.pattern;
    const double* const panel = work.matrix.panel(j);
    const int blocks = pattern.start[j + 1] - pattern.start[j];
    for (int k = 0; k < blocks; ++k) {
      double* const block = column + work.place[pattern.row[pattern.start[j] + k]];
      for (int c = 0; c < b; ++c)
        for (int r = 0; r < b; ++r) block[c * b + r] = panel[(c * blocks + k) * b + r];
    }
    for (int k = list[j]; k >= 0;) {
      const int next = link[k];
      const int first = work.next_block[k], last = work.factor.start[k + 1];
      const double* const L_jk = work.values + static_cast<std::ptrdiff_t>(first) * square;
      const double* L_ik = L_jk;
      for (int q = first; q < last; ++q, L_ik += square)
        subtract_product<b>(column + work.place[row[q]], L_ik, L_jk);
      if (first + 1 < last) {
        work.next_block[k] = first + 1;
        link[k] = list[row[first + 1]];
        list[row[first + 1]] = k;
      }
      k = next;
    }
    if (!factorize_diagonal<b>(column)) return false;
    for (int k = 1; k < end - begin; ++k) divide_by_transpose<b>(column + k * square, column);
    if (end - begin > 1) {
      work.next_block[j] = begin + 1;
      link[j] = list[row[begin + 1]];
      list[row[begin + 1]] = j;
    }
  }
  return true;
}

template <int b>
PLACEGRAPH_INLINE void solve_blocks(const BlockColumns& factor, const double* values, double* x) {
  constexpr int square = b * b;
  const int count = factor.count();
  for (int j = 0; j < count; ++j) {
    const double* block = values + static_cast<std::ptrdiff_t>(factor.start[j]) * square;
    double* const x_j = x + static_cast<std::ptrdiff_t>(j) * b;
    for (int c = 0; c < b; ++c) {
      x_j[c] /= block[c * b + c];
      for (int r = c + 1; r < b; ++r) x_j[r] -= block[c * b + r] * x_j[c];
    }
    for (int k = factor.start[j] + 1; k < factor.start[j + 1]; ++k) {
      block += square;
      double* const x_i = x + static_cast<std::ptrdiff_t>(factor.row[k]) * b;
      for (int c = 0; c < b; ++c)
        for (int r = 0; r < b; ++r) x_i[r] -= block[c * b + r] * x_j[c];
    }
  }
  for (int j = count - 1; j >= 0; --j) {
    const double* const diagonal = values + static_cast<std::ptrdiff_t>(factor.start[j]) * square;
    double* const x_j = x + static_cast<std::ptrdiff_t>(j) * b;
    const double* block = diagonal;
    for (int k = factor.start[j] + 1; k < factor.start[j + 1]; ++k) {
      block += square;
      const double* const x_i = x + static_cast<std::ptrdiff_t>(factor.row[k]) * b;
      for (int c = 0; c < b; ++c)
        for (int r = 0; r < b; ++r) x_j[c] -= block[c * b + r] * x_i[r];
    }
    for (int c = b - 1; c >= 0; --c) {
      for (int r = c + 1; r < b; ++r) x_j[c] -= diagonal[c * b + r] * x_j[r];
      x_j[c] /= diagonal[c * b + c];
    }
  }
}

#define PLACEGRAPH_KERNEL(b)                                                                   \
  PLACEGRAPH_CLONES bool factorize_##b(const Work& work) { return factorize_blocks<b>(work); } \
  PLACEGRAPH_CLONES void solve_##b(const BlockColumns& factor, const double* v, double* x) {   \
    solve_blocks<b>(factor, v, x);                                                             \
  }
PLACEGRAPH_KERNEL(1)
PLACEGRAPH_KERNEL(2)
PLACEGRAPH_KERNEL(3)
PLACEGRAPH_KERNEL(6)
PLACEGRAPH_KERNEL(7)
#undef PLACEGRAPH_KERNEL

}  // namespace

bool SimplicialFactor::has_kernel(int block_size) {
  return (block_size >= 1 && block_size <= 3) || block_size == 6 || block_size == 7;
}

SimplicialFactor::SimplicialFactor(const BlockPanels& matrix)
    : block_size_(matrix.block_size), factor_{fill_in(matrix.pattern), {}} {
  require(has_kernel(block_size_), "SimplicialFactor: no kernel for this block size");
  factor_.values.resize(factor_.pattern.row.size() * block_size_ * block_size_);
  for (std::vector<int>* work : {&place_, &list_, &link_, &next_block_})
    work->resize(static_cast<std::size_t>(factor_.pattern.count()));
}

bool SimplicialFactor::factorize(const BlockPanels& matrix) {
  const Work work{matrix,       factor_.pattern, factor_.values.data(), place_.data(),
                  list_.data(), link_.data(),    next_block_.data()};
  switch (block_size_) {
    case 1:
      return factorize_1(work);
    case 2:
      return factorize_2(work);
    case 3:
      return factorize_3(work);
    case 6:
      return factorize_6(work);
    default:
      return factorize_7(work);
  }
}

void SimplicialFactor::solve(Eigen::Ref<Eigen::MatrixXd> x) const {
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    check_interruption();
    double* const column = x.col(c).data();
    switch (block_size_) {
      case 1:
        solve_1(factor_.pattern, factor_.values.data(), column);
        break;
      case 2:
        solve_2(factor_.pattern, factor_.values.data(), column);
        break;
      case 3:
        solve_3(factor_.pattern, factor_.values.data(), column);
        break;
      case 6:
        solve_6(factor_.pattern, factor_.values.data(), column);
        break;
      default:
        solve_7(factor_.pattern, factor_.values.data(), column);
    }
  }
}

Eigen::VectorXd SimplicialFactor::pivots() const {
  const int count = factor_.pattern.count();
  Eigen::VectorXd pivots(static_cast<Eigen::Index>(count) * block_size_);
  for (int j = 0, i = 0; j < count; ++j) {
    const double* const diagonal =
        &factor_.values[static_cast<std::size_t>(factor_.pattern.start[j]) * block_size_ *
                        block_size_];
    for (int c = 0; c < block_size_; ++c, ++i) pivots[i] = diagonal[c * block_size_ + c];
  }
  return pivots;
}

}  // namespace placegraph
