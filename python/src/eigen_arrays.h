#pragma once
#include <nanobind/ndarray.h>

#include <Eigen/Core>
#include <algorithm>
#include <type_traits>

namespace nanobind::detail {

/// Matrices and vectors of Eigen as arrays that cannot be written to: what a program writes into a
/// copy would be lost without a word. (nanobind's own conversion gives arrays that can.)
template <class Scalar, int rows, int columns, int options, int most_rows, int most_columns>
struct type_caster<Eigen::Matrix<Scalar, rows, columns, options, most_rows, most_columns>> {
  using Matrix = Eigen::Matrix<Scalar, rows, columns, options, most_rows, most_columns>;
  static constexpr bool kVector = rows == 1 || columns == 1;
  using Shape = std::conditional_t<kVector, shape<Matrix::SizeAtCompileTime>, shape<rows, columns>>;
  using Order = std::conditional_t<kVector || Matrix::IsRowMajor, c_contig, f_contig>;
  using Array = ndarray<const Scalar, numpy, Shape, Order>;
  using ArrayCaster = make_caster<Array>;
  NB_TYPE_CASTER(Matrix, ArrayCaster::Name)

  bool from_python(handle source, uint32_t flags, cleanup_list* cleanup) noexcept {
    ArrayCaster caster;
    if (!caster.from_python(source, flags & ~cast_flags::accepts_none, cleanup)) return false;
    const Array& array = caster.value;
    if constexpr (kVector)
      value.resize(static_cast<Eigen::Index>(array.shape(0)));
    else
      value.resize(static_cast<Eigen::Index>(array.shape(0)),
                   static_cast<Eigen::Index>(array.shape(1)));
    std::copy_n(array.data(), array.size(), value.data());
    return true;
  }

  static handle from_cpp(const Matrix& matrix, rv_policy, cleanup_list* cleanup) noexcept {
    auto* kept = new Matrix(matrix);
    const capsule owner(kept, [](void* p) noexcept { delete static_cast<Matrix*>(p); });
    std::size_t sizes[2] = {static_cast<std::size_t>(kept->rows()),
                            static_cast<std::size_t>(kept->cols())};
    std::int64_t strides[2] = {kept->rowStride(), kept->colStride()};
    if constexpr (kVector) {
      sizes[0] = static_cast<std::size_t>(kept->size());
      strides[0] = kept->innerStride();
    }
    return ArrayCaster::from_cpp(Array(kept->data(), kVector ? 1 : 2, sizes, owner, strides),
                                 rv_policy::reference, cleanup);
  }
};

}  // namespace nanobind::detail
