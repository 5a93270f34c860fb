#pragma once

namespace placegraph {

/// Dense kernels of one front.
/// A front is the lower triangle of a symmetric `rows` x `rows` matrix, column by column, of which
/// the first `frontal` columns are eliminated. Both are multiples of D. Small fronts use loops over
/// blocks of D, large ones BLAS.
template <int D>
struct FrontKernels {
  /// [A11; A21 A22] -> [L11; L21 A22 - L21 L21^T] with L11 L11^T = A11, in place. False if a pivot
  /// is not positive; the matrix is undefined then.
  [[nodiscard]] static bool factorize(double* matrix, int rows, int frontal);
  /// [b1; b2] -> [y; b2 - L21 y] with L11 y = b1, in place.
  static void forward(const double* matrix, int rows, int frontal, double* b);
  /// [y; x2] -> [x1; x2] with L11^T x1 = y - L21^T x2, in place.
  static void backward(const double* matrix, int rows, int frontal, double* x);
};

}  // namespace placegraph
