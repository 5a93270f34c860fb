#pragma once
// Decompositions and products of the usual sizes, compiled once for the whole build (in
// eigen_instances.cpp) instead of in every source that uses them: half the time of compiling many
// of them. The build precompiles this header; no source includes it, and nothing changes without
// it. Kernels are named by Eigen's own traits, so that they are those of any processor.
#include <Eigen/Dense>

#ifndef PLACEGRAPH_EXTERN
#define PLACEGRAPH_EXTERN extern
#endif

#if EIGEN_VERSION_AT_LEAST(3, 4, 0) && !EIGEN_VERSION_AT_LEAST(3, 4, 90)

#define PLACEGRAPH_SYMMETRIC(N)                                                                 \
  PLACEGRAPH_EXTERN template SelfAdjointEigenSolver<Matrix<double, N, N>>&                      \
  SelfAdjointEigenSolver<Matrix<double, N, N>>::compute(const EigenBase<Matrix<double, N, N>>&, \
                                                        int);

#define PLACEGRAPH_SOLVES(SOLVER, N, COLUMNS)                                                 \
  PLACEGRAPH_EXTERN template void SOLVER<Matrix<double, N, N>>::_solve_impl_transposed<true>( \
      const Matrix<double, N, COLUMNS>&, Matrix<double, N, COLUMNS>&) const;

#define PLACEGRAPH_CHOLESKY(SOLVER, N)                                                            \
  PLACEGRAPH_EXTERN template SOLVER<Matrix<double, N, N>>& SOLVER<Matrix<double, N, N>>::compute( \
      const EigenBase<Matrix<double, N, N>>&);                                                    \
  PLACEGRAPH_EXTERN template void SOLVER<Matrix<double, N, N>>::_solve_impl_transposed<true>(     \
      const CwiseNullaryOp<internal::scalar_identity_op<double>, Matrix<double, N, N>>&,          \
      Matrix<double, N, N>&) const;                                                               \
  PLACEGRAPH_SOLVES(SOLVER, N, N)

namespace Eigen {

PLACEGRAPH_SYMMETRIC(2)
PLACEGRAPH_SYMMETRIC(3)
PLACEGRAPH_SYMMETRIC(6)
PLACEGRAPH_SYMMETRIC(Dynamic)

PLACEGRAPH_CHOLESKY(LDLT, 3)
PLACEGRAPH_CHOLESKY(LDLT, 6)
PLACEGRAPH_CHOLESKY(LDLT, Dynamic)
PLACEGRAPH_SOLVES(LDLT, 3, 1)
PLACEGRAPH_SOLVES(LDLT, 6, 1)
PLACEGRAPH_SOLVES(LDLT, Dynamic, 1)
PLACEGRAPH_CHOLESKY(LLT, 3)
PLACEGRAPH_CHOLESKY(LLT, 6)
PLACEGRAPH_CHOLESKY(LLT, Dynamic)
PLACEGRAPH_SOLVES(LLT, 3, 1)
PLACEGRAPH_SOLVES(LLT, 6, 1)
PLACEGRAPH_SOLVES(LLT, Dynamic, 1)

PLACEGRAPH_EXTERN template JacobiSVD<Matrix3d>& JacobiSVD<Matrix3d>::compute(const Matrix3d&,
                                                                             unsigned);
PLACEGRAPH_EXTERN template JacobiSVD<Matrix<double, 2, 3>>&
JacobiSVD<Matrix<double, 2, 3>>::compute(const Matrix<double, 2, 3>&, unsigned);
PLACEGRAPH_EXTERN template void PartialPivLU<Matrix<double, 6, 6>>::compute();
PLACEGRAPH_EXTERN template void PartialPivLU<MatrixXd>::compute();

namespace internal {

// What is left of the above where the argument is an expression.
#define PLACEGRAPH_TRIDIAGONAL(N, M)                                                              \
  PLACEGRAPH_EXTERN template void tridiagonalization_inplace(Matrix<double, N, N>&,               \
                                                             Matrix<double, M, 1>&);              \
  PLACEGRAPH_EXTERN template void tridiagonalization_inplace(                                     \
      Matrix<double, N, N>&, Matrix<double, N, 1>&, Matrix<double, M, 1>&, Matrix<double, M, 1>&, \
      bool);                                                                                      \
  PLACEGRAPH_EXTERN template ComputationInfo computeFromTridiagonal_impl(                         \
      Matrix<double, N, 1>&, Matrix<double, M, 1>&, Index, bool, Matrix<double, N, N>&);
PLACEGRAPH_TRIDIAGONAL(6, 5)
PLACEGRAPH_TRIDIAGONAL(7, 6)
PLACEGRAPH_TRIDIAGONAL(Dynamic, Dynamic)

using Traits = gebp_traits<double, double>;
template <int Order>
using ConstMapper = const_blas_data_mapper<double, Index, Order>;
using Mapper = blas_data_mapper<double, Index, ColMajor, Unaligned, 1>;

PLACEGRAPH_EXTERN template struct gebp_kernel<double, double, Index, Mapper, Traits::mr, Traits::nr,
                                              false, false>;
PLACEGRAPH_EXTERN template struct gemm_pack_lhs<double, Index, ConstMapper<ColMajor>, Traits::mr,
                                                Traits::LhsProgress, Traits::LhsPacket4Packing,
                                                ColMajor>;
PLACEGRAPH_EXTERN template struct gemm_pack_lhs<double, Index, ConstMapper<RowMajor>, Traits::mr,
                                                Traits::LhsProgress, Traits::LhsPacket4Packing,
                                                RowMajor>;
PLACEGRAPH_EXTERN template struct gemm_pack_rhs<double, Index, Mapper, Traits::nr, ColMajor, false,
                                                true>;
PLACEGRAPH_EXTERN template struct gemm_pack_rhs<double, Index, ConstMapper<ColMajor>, Traits::nr,
                                                ColMajor>;
PLACEGRAPH_EXTERN template struct gemm_pack_rhs<double, Index, ConstMapper<RowMajor>, Traits::nr,
                                                RowMajor>;

#define PLACEGRAPH_GEMM(LHS, RHS)                                  \
  PLACEGRAPH_EXTERN template struct general_matrix_matrix_product< \
      Index, double, LHS, false, double, RHS, false, ColMajor, 1>;
PLACEGRAPH_GEMM(ColMajor, ColMajor)
PLACEGRAPH_GEMM(ColMajor, RowMajor)
PLACEGRAPH_GEMM(RowMajor, ColMajor)

#define PLACEGRAPH_GEMV(LHS, RHS, VERSION)                         \
  PLACEGRAPH_EXTERN template struct general_matrix_vector_product< \
      Index, double, ConstMapper<LHS>, LHS, false, double, ConstMapper<RHS>, false, VERSION>;
PLACEGRAPH_GEMV(ColMajor, ColMajor, 0)
PLACEGRAPH_GEMV(ColMajor, RowMajor, 0)
PLACEGRAPH_GEMV(RowMajor, ColMajor, 0)
PLACEGRAPH_GEMV(RowMajor, RowMajor, 1)
PLACEGRAPH_EXTERN template struct selfadjoint_matrix_vector_product<double, Index, ColMajor, Lower,
                                                                    false, false>;

#define PLACEGRAPH_TRIANGULAR_SOLVE(SIDE, MODE, ORDER)                                        \
  PLACEGRAPH_EXTERN template struct triangular_solve_matrix<double, Index, SIDE, MODE, false, \
                                                            ORDER, ColMajor, 1>;
PLACEGRAPH_TRIANGULAR_SOLVE(OnTheLeft, Lower, ColMajor)
PLACEGRAPH_TRIANGULAR_SOLVE(OnTheLeft, Upper, ColMajor)
PLACEGRAPH_TRIANGULAR_SOLVE(OnTheLeft, Upper, RowMajor)
PLACEGRAPH_TRIANGULAR_SOLVE(OnTheLeft, UnitLower, ColMajor)
PLACEGRAPH_TRIANGULAR_SOLVE(OnTheLeft, UnitUpper, RowMajor)
PLACEGRAPH_TRIANGULAR_SOLVE(OnTheRight, Upper, RowMajor)

#define PLACEGRAPH_TRIANGULAR_PRODUCT(MODE, ORDER)                    \
  PLACEGRAPH_EXTERN template struct product_triangular_matrix_matrix< \
      double, Index, MODE, true, ORDER, false, ColMajor, false, ColMajor, 1>;
PLACEGRAPH_TRIANGULAR_PRODUCT(Lower, ColMajor)
PLACEGRAPH_TRIANGULAR_PRODUCT(Upper, RowMajor)
PLACEGRAPH_TRIANGULAR_PRODUCT(UnitLower, ColMajor)
PLACEGRAPH_TRIANGULAR_PRODUCT(UnitUpper, RowMajor)

}  // namespace internal
}  // namespace Eigen

#endif
