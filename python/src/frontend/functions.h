#pragma once
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "python/src/arrays.h"
#include "python/src/graph/images.h"
#include "python/src/options.h"

namespace placegraph::python {

/// A parameter with the options of a function: None for the defaults, or options of the package.
template <class Options>
struct OptionsArgument {
  nb::object value;

  /// The options; throws ArgumentError, which names the argument, for anything else.
  Options get(const char* argument = "options") const {
    if (value.is_none()) return {};
    const nb::object set = nb::getattr(value, "_set", value);
    const OptionSet* given = nullptr;
    if (!nb::try_cast<const OptionSet*>(set, given) || given == nullptr)
      throw ArgumentError(std::string(argument) + ": options are needed, not " +
                          nb::repr(value.type()).c_str());
    return options_in<Options>(*given, argument);
  }
};

/// A class for the options of a function, which Options of the package wraps.
template <class Options>
void bind_option_set(nb::module_& m, const char* name, const char* docstring) {
  using Set = OptionSetOf<Options>;
  nb::class_<Set, OptionSet>(m, name, docstring).def(nb::init<>(), "The defaults.");
}

/// A parameter that should be a grey image; get() names the argument if it is none.
struct GreyArgument {
  nb::object value;
  Image get(const char* argument) const { return grey_image(value, argument); }
  /// No image for None.
  Image get_optional(const char* argument) const {
    return value.is_none() ? Image() : get(argument);
  }
};

/// A parameter that should be a grey or a colour image.
struct PictureArgument {
  nb::object value;
  Image get(const char* argument) const;
};

/// A parameter that should be a depth image.
struct DepthArgument {
  nb::object value;
  Image get(const char* argument) const { return depth_image(value, argument); }
};

/// A parameter that should be an optical flow, H x W x 2.
struct FlowArgument {
  nb::object value;
  Image get(const char* argument) const { return flow_image(value, argument); }
};

/// An image that is returned as an array, see array_of.
template <class Number>
struct ImageResult {
  Image image;
};

/// Rows of an array, as points of the library.
std::vector<Eigen::Vector2d> points_2d(const ArrayArgument<double>& array, const char* argument);
std::vector<Eigen::Vector3d> points_3d(const ArrayArgument<double>& array, const char* argument,
                                       Values values = Values::kFinite);
/// A matrix of the given shape.
Eigen::Matrix3d matrix_3x3(const ArrayArgument<double>& array, const char* argument);
Eigen::Vector3d vector_3(const ArrayArgument<double>& array, const char* argument);
/// A vector of three numbers made one long; throws ArgumentError if it has no length.
Eigen::Vector3d direction_3(const ArrayArgument<double>& array, const char* argument);
/// Throws ArgumentError, which names `argument`, unless both have as many rows.
void require_same_rows(std::size_t rows, std::size_t wanted, const char* argument,
                       const char* other);

/// The choice of a name; throws ArgumentError, which lists the names, for another one.
template <class Enum>
Enum choice_of(const std::string& name, const std::vector<std::string>& names,
               const char* argument) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return static_cast<Enum>(i);
  std::string all;
  for (const std::string& each : names) all += (all.empty() ? "'" : ", '") + each + "'";
  throw ArgumentError(std::string(argument) + ": one of " + all + " is needed, not '" + name + "'");
}

/// A view of numbers that an object of Python holds, which it keeps alive; read only.
template <class Number, class Owner>
ReadOnlyArray<Number> view_of(const std::vector<Number>& values, const Owner& owner) {
  const std::size_t shape[1] = {values.size()};
  return ReadOnlyArray<Number>(values.data(), 1, shape, nb::find(owner));
}

/// The same of points, N x 2 or N x 3.
template <int kSize, class Owner>
ReadOnlyArray<double> view_of(const std::vector<Eigen::Matrix<double, kSize, 1>>& points,
                              const Owner& owner) {
  static_assert(sizeof(points[0]) == kSize * sizeof(double));
  const std::size_t shape[2] = {points.size(), kSize};
  const double* first = points.empty() ? nullptr : points[0].data();
  return ReadOnlyArray<double>(first, 2, shape, nb::find(owner));
}

/// The properties of a result that tell whether it may be used.
template <class Class>
void bind_outcome(Class& result) {
  using Result = typename Class::Type;
  result
      .def_prop_ro(
          "ok", [](const Result& r) { return static_cast<bool>(r.outcome); }, doc("Outcome::bool"))
      .def_prop_ro(
          "outcome", [](const Result& r) { return to_string(r.outcome.code); },
          "Name of the outcome: \"ok\", \"too few data\", \"no consensus\", \"degenerate\" ...")
      .def_prop_ro(
          "reason", [](const Result& r) { return r.outcome.reason; }, doc("Outcome::reason"))
      .def("__bool__", [](const Result& r) { return static_cast<bool>(r.outcome); });
}

}  // namespace placegraph::python

namespace nanobind::detail {

/// A parameter of any type, which is examined in the function so that errors name it.
#define PLACEGRAPH_ARGUMENT_CASTER(TYPE, NAME)                         \
  template <>                                                          \
  struct type_caster<TYPE> {                                           \
    NB_TYPE_CASTER(TYPE, const_name(NAME))                             \
    bool from_python(handle source, uint8_t, cleanup_list*) noexcept { \
      value.value = borrow(source);                                    \
      return true;                                                     \
    }                                                                  \
  };

PLACEGRAPH_ARGUMENT_CASTER(placegraph::python::GreyArgument, "numpy.typing.NDArray[numpy.uint8]")
PLACEGRAPH_ARGUMENT_CASTER(placegraph::python::PictureArgument, "numpy.typing.NDArray[numpy.uint8]")
PLACEGRAPH_ARGUMENT_CASTER(placegraph::python::DepthArgument, "numpy.typing.NDArray[numpy.float32]")
PLACEGRAPH_ARGUMENT_CASTER(placegraph::python::FlowArgument, "numpy.typing.NDArray[numpy.float32]")
#undef PLACEGRAPH_ARGUMENT_CASTER

template <class Number>
struct type_caster<placegraph::python::ImageResult<Number>> {
  using Result = placegraph::python::ImageResult<Number>;
  static constexpr auto kDtype = const_name<std::is_same_v<Number, float>>("float32", "uint8");
  NB_TYPE_CASTER(Result, const_name("numpy.typing.NDArray[numpy.") + kDtype + const_name("]"))

  static handle from_cpp(const Result& result, rv_policy, cleanup_list*) noexcept {
    return placegraph::python::array_of(result.image, placegraph::python::Access::kReadWrite)
        .release();
  }
};

template <class Options>
struct type_caster<placegraph::python::OptionsArgument<Options>> {
  NB_TYPE_CASTER(placegraph::python::OptionsArgument<Options>,
                 const_name("placegraph.options.OptionGroup"))

  bool from_python(handle source, uint8_t, cleanup_list*) noexcept {
    value.value = borrow(source);
    return true;
  }
};

}  // namespace nanobind::detail
