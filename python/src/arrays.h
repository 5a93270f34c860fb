#pragma once
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "python/src/bindings.h"
#include "python/src/tuples.h"

namespace placegraph::python {

/// Any size of a dimension.
inline constexpr int kAny = -1;

/// A dictionary by names, and a list of such.
using Table = nb::typed<nb::dict, nb::str, nb::any>;
using TableList = nb::typed<nb::list, Table>;

/// The value of an argument as an array of a type and shape (kAny: any size), row by row.
///
/// What numpy converts without loss is converted (integers to float64, lists, uint64 below 2^63 to
/// int64, times to an argument in _ns), and an object with as_matrix() to its matrices; an array
/// that fits is not copied. Throws ArgumentError, which names the argument, for anything else, and
/// for values that are not finite if `finite`. `form` is the wanted shape in messages, where
/// `shape` does not tell it.
nb::object checked_array(nb::handle value, const char* argument, const char* dtype,
                         const std::vector<int>& shape, bool finite, const std::string& form = "");

/// The shape of a value as an array; empty for rows of different lengths.
std::vector<std::size_t> shape_of(nb::handle value);

template <class Number>
constexpr const char* dtype_name() {
  if constexpr (std::is_same_v<Number, double>) return "float64";
  if constexpr (std::is_same_v<Number, float>) return "float32";
  if constexpr (std::is_same_v<Number, std::int64_t>) return "int64";
  if constexpr (std::is_same_v<Number, std::int32_t>) return "int32";
  if constexpr (std::is_same_v<Number, std::uint8_t>) return "uint8";
  if constexpr (std::is_same_v<Number, bool>) return "bool";
}

/// Whether values that are not finite are taken.
enum class Values { kFinite, kUnchecked };

/// An array that is read; it keeps its owner alive.
template <class Number>
using ArrayView = nb::ndarray<const Number, nb::c_contig, nb::device::cpu>;

/// A parameter that should be an array of numbers; the type checkers see it as such.
template <class Number>
struct ArrayArgument {
  nb::object value;

  /// The array, see checked_array; `argument` is the name of the parameter.
  ArrayView<Number> get(const char* argument, const std::vector<int>& shape,
                        Values values = Values::kFinite, const std::string& form = "") const {
    return nb::cast<ArrayView<Number>>(checked_array(value, argument, dtype_name<Number>(), shape,
                                                     values == Values::kFinite, form));
  }

  /// A quaternion x y z w: four numbers, or a rotation of scipy.
  ArrayView<Number> get_xyzw(const char* argument) const {
    if (!nb::hasattr(value, "as_quat")) return get(argument, {4});
    return ArrayArgument{value.attr("as_quat")()}.get(argument, {4});
  }
};

/// An array that cannot be written to, as all that the package gives: what a program writes into a
/// copy would be lost without a word.
template <class T>
using ReadOnlyArray = nb::ndarray<nb::numpy, const T>;

/// For properties whose arrays are made by the call: they are no parts of the object.
inline constexpr auto kNew = nb::rv_policy::automatic;

/// An array that owns its values, which are moved there.
template <class T>
ReadOnlyArray<T> owned_array(std::vector<T> values, std::vector<std::size_t> shape) {
  std::size_t size = 1;
  for (const std::size_t each : shape) size *= each;
  if (size != values.size()) throw std::logic_error("an array has other values than its shape");
  auto data = std::make_unique<std::vector<T>>(std::move(values));
  T* first = data->data();
  const nb::capsule keep(data.release(),
                         [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  return ReadOnlyArray<T>(first, shape.size(), shape.data(), keep);
}

/// An optional package of Python. Raises ImportError that names the extra that installs it.
nb::module_ module_for(const char* name, const char* extra);

/// Appends a matrix row by row.
template <class Matrix>
void append_rows(const Matrix& matrix, std::vector<double>& values) {
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    for (Eigen::Index column = 0; column < matrix.cols(); ++column)
      values.push_back(matrix(row, column));
}

}  // namespace placegraph::python

namespace nanobind::detail {

template <class Number>
struct type_caster<placegraph::python::ArrayArgument<Number>> {
  NB_TYPE_CASTER(placegraph::python::ArrayArgument<Number>, const_name("numpy.typing.ArrayLike"))

  bool from_python(handle source, uint8_t, cleanup_list*) noexcept {
    value.value = borrow(source);
    return true;
  }
};

}  // namespace nanobind::detail
