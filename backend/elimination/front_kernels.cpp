#include <placegraph/backend/elimination/front_kernels.h>
#include <placegraph/graph/core/function_clones.h>

#include <cmath>
#include <cstddef>
#include <type_traits>

extern "C" {
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
void dtrsm_(const char* side, const char* uplo, const char* trans, const char* diag, const int* m,
            const int* n, const double* alpha, const double* a, const int* lda, double* b,
            const int* ldb);
void dsyrk_(const char* uplo, const char* trans, const int* n, const int* k, const double* alpha,
            const double* a, const int* lda, const double* beta, double* c, const int* ldc);
void dtrsv_(const char* uplo, const char* trans, const char* diag, const int* n, const double* a,
            const int* lda, double* x, const int* incx);
void dgemv_(const char* trans, const int* m, const int* n, const double* alpha, const double* a,
            const int* lda, const double* x, const int* incx, const double* beta, double* y,
            const int* incy);
}

namespace placegraph {
namespace {

/// Number of rows from which BLAS is faster than the loops (measured).
constexpr int kBlasRows = 64;

bool factorize_with_blas(double* matrix, int rows, int frontal) {
  int info = 0;
  dpotrf_("L", &frontal, matrix, &rows, &info);
  if (info != 0) return false;
  const int below = rows - frontal;
  if (below == 0) return true;
  const double one = 1, minus_one = -1;
  double* const L21 = matrix + frontal;
  dtrsm_("R", "L", "T", "N", &below, &frontal, &one, matrix, &rows, L21, &rows);
  dsyrk_("L", "N", &below, &frontal, &minus_one, L21, &rows, &one,
         matrix + static_cast<std::size_t>(frontal) * rows + frontal, &rows);
  return true;
}

/// Cholesky of the D columns from `column` on (with their diagonal block at the top), including the
/// rows below.
template <int D>
PLACEGRAPH_INLINE bool factorize_panel(double* column, int rows, int below) {
  for (int c = 0; c < D; ++c) {
    double* __restrict const current = column + static_cast<std::size_t>(c) * rows;
    for (int p = 0; p < c; ++p) {
      const double* const done = column + static_cast<std::size_t>(p) * rows;
      const double factor = done[c];
      for (int i = c; i < D + below; ++i) current[i] -= factor * done[i];
    }
    if (!(current[c] > 0)) return false;
    const double inverse = 1 / std::sqrt(current[c]);
    for (int i = c; i < D + below; ++i) current[i] *= inverse;
  }
  return true;
}

template <int D>
PLACEGRAPH_INLINE bool factorize_by_panels(double* matrix, int rows, int frontal) {
  for (int k = 0; k < frontal; k += D) {
    double* const panel = matrix + static_cast<std::size_t>(k) * rows + k;
    const int below = rows - k - D;
    if (!factorize_panel<D>(panel, rows, below)) return false;
    for (int j = 0; j < below; ++j) {
      double* __restrict const target = matrix + static_cast<std::size_t>(k + D + j) * rows + k + D;
      const double* const source = panel + D;
      double factor[D];
      for (int c = 0; c < D; ++c) factor[c] = source[static_cast<std::size_t>(c) * rows + j];
      for (int i = j; i < below; ++i) {
        double sum = 0;
        for (int c = 0; c < D; ++c)
          sum += factor[c] * source[static_cast<std::size_t>(c) * rows + i];
        target[i] -= sum;
      }
    }
  }
  return true;
}

PLACEGRAPH_CLONES bool factorize_small(double* matrix, int rows, int frontal,
                                       std::integral_constant<int, 3>) {
  return factorize_by_panels<3>(matrix, rows, frontal);
}
PLACEGRAPH_CLONES bool factorize_small(double* matrix, int rows, int frontal,
                                       std::integral_constant<int, 6>) {
  return factorize_by_panels<6>(matrix, rows, frontal);
}
PLACEGRAPH_CLONES bool factorize_small(double* matrix, int rows, int frontal,
                                       std::integral_constant<int, 7>) {
  return factorize_by_panels<7>(matrix, rows, frontal);
}

PLACEGRAPH_CLONES void forward_small(const double* matrix, int rows, int frontal, double* b) {
  for (int k = 0; k < frontal; ++k) {
    const double* const column = matrix + static_cast<std::size_t>(k) * rows;
    const double y = b[k] /= column[k];
    for (int i = k + 1; i < rows; ++i) b[i] -= column[i] * y;
  }
}

PLACEGRAPH_CLONES void backward_small(const double* matrix, int rows, int frontal, double* x) {
  for (int k = frontal - 1; k >= 0; --k) {
    const double* const column = matrix + static_cast<std::size_t>(k) * rows;
    double sums[4] = {0, 0, 0, 0};
    int i = k + 1;
    for (; i + 4 <= rows; i += 4)
      for (int l = 0; l < 4; ++l) sums[l] += column[i + l] * x[i + l];
    for (; i < rows; ++i) sums[0] += column[i] * x[i];
    x[k] = (x[k] - ((sums[0] + sums[1]) + (sums[2] + sums[3]))) / column[k];
  }
}

}  // namespace

template <int D>
bool FrontKernels<D>::factorize(double* matrix, int rows, int frontal) {
  if (rows >= kBlasRows) return factorize_with_blas(matrix, rows, frontal);
  return factorize_small(matrix, rows, frontal, std::integral_constant<int, D>());
}

template <int D>
void FrontKernels<D>::forward(const double* matrix, int rows, int frontal, double* b) {
  if (rows < kBlasRows) return forward_small(matrix, rows, frontal, b);
  const int one = 1, below = rows - frontal;
  const double plus = 1, minus = -1;
  dtrsv_("L", "N", "N", &frontal, matrix, &rows, b, &one);
  if (below > 0)
    dgemv_("N", &below, &frontal, &minus, matrix + frontal, &rows, b, &one, &plus, b + frontal,
           &one);
}

template <int D>
void FrontKernels<D>::backward(const double* matrix, int rows, int frontal, double* x) {
  if (rows < kBlasRows) return backward_small(matrix, rows, frontal, x);
  const int one = 1, below = rows - frontal;
  const double plus = 1, minus = -1;
  if (below > 0)
    dgemv_("T", &below, &frontal, &minus, matrix + frontal, &rows, x + frontal, &one, &plus, x,
           &one);
  dtrsv_("L", "T", "N", &frontal, matrix, &rows, x, &one);
}

template struct FrontKernels<3>;
template struct FrontKernels<6>;
template struct FrontKernels<7>;

}  // namespace placegraph
