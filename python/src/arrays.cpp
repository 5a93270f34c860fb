#include "python/src/arrays.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>

#include <limits>
#include <string>
#include <string_view>

namespace placegraph::python {
namespace {

using namespace nb::literals;

std::string text_of_shape(const std::vector<int>& shape) {
  std::string text;
  for (const int size : shape)
    text += (text.empty() ? "" : " x ") + (size == kAny ? "N" : std::to_string(size));
  return text;
}

/// Whether Python takes a value, also one of numpy, for true.
bool is_true(const nb::object& value) { return PyObject_IsTrue(value.ptr()) == 1; }

/// Whether values of uint64, as the keys of other programs, are wanted as int64. Throws
/// ArgumentError if one is too large.
bool are_keys(const nb::object& array, const std::string& dtype, const char* argument) {
  if (dtype != "int64" || nb::cast<std::string>(array.attr("dtype").attr("kind")) != "u")
    return false;
  const nb::int_ largest(std::numeric_limits<std::int64_t>::max());
  if (!is_true(array.attr("__le__")(largest).attr("all")()))
    throw ArgumentError(fmt::format("{}: a value is not below 2^63", argument));
  return true;
}

/// The matrices of an object that has them, as the rotations and motions of scipy.
nb::object plain(nb::handle value) {
  if (nb::hasattr(value, "as_matrix")) return value.attr("as_matrix")();
  return nb::borrow(value);
}

/// Times of numpy, of any unit, as nanoseconds; any other array stays.
nb::object as_nanoseconds(const nb::object& array, const char* argument) {
  if (nb::cast<std::string>(array.attr("dtype").attr("kind")) != "M") return array;
  if (!std::string_view(argument).ends_with("_ns")) return array;
  const nb::module_ numpy = nb::module_::import_("numpy");
  if (is_true(numpy.attr("isnat")(array).attr("any")()))
    throw ArgumentError(fmt::format("{}: a value is no time", argument));
  const nb::object times = array.attr("astype")("datetime64[ns]");
  if (!is_true(times.attr("astype")(array.attr("dtype")).attr("__eq__")(array).attr("all")()))
    throw ArgumentError(
        fmt::format("{}: a time is not in nanoseconds, or not between 1678 and 2262", argument));
  return times.attr("astype")("int64");
}

}  // namespace

nb::object checked_array(nb::handle value, const char* argument, const char* dtype,
                         const std::vector<int>& shape, bool finite, const std::string& form) {
  const nb::module_ numpy = nb::module_::import_("numpy");
  const std::string wanted = fmt::format("{}: an array of {}, {}, is needed", argument, dtype,
                                         form.empty() ? text_of_shape(shape) : form);
  nb::object array;
  try {
    array = as_nanoseconds(numpy.attr("asarray")(plain(value)), argument);
  } catch (const nb::python_error& error) {      // rows of different lengths
    if (!error.matches(PyExc_Exception)) throw;  // KeyboardInterrupt
    throw ArgumentError(wanted);
  }
  const auto text = [](nb::handle object) { return std::string(nb::str(object).c_str()); };
  // An empty list has the type of a float.
  const bool safe = nb::cast<std::size_t>(array.attr("size")) == 0 ||
                    is_true(numpy.attr("can_cast")(array.attr("dtype"), dtype, "safe")) ||
                    are_keys(array, dtype, argument);
  if (!safe) throw ArgumentError(fmt::format("{}, not of {}", wanted, text(array.attr("dtype"))));
  const auto sizes = nb::cast<std::vector<std::size_t>>(array.attr("shape"));
  bool fits = sizes.size() == shape.size();
  for (std::size_t i = 0; fits && i < shape.size(); ++i)
    fits = shape[i] == kAny || sizes[i] == static_cast<std::size_t>(shape[i]);
  if (!fits)
    throw ArgumentError(fmt::format("{}, not of shape {}", wanted, text(array.attr("shape"))));
  array = numpy.attr("ascontiguousarray")(array, "dtype"_a = dtype);
  if (finite && !is_true(numpy.attr("isfinite")(array).attr("all")()))
    throw ArgumentError(fmt::format("{}: a value is not finite", argument));
  return array;
}

std::vector<std::size_t> shape_of(nb::handle value) {
  try {
    return nb::cast<std::vector<std::size_t>>(
        nb::module_::import_("numpy").attr("shape")(plain(value)));
  } catch (const nb::python_error& error) {      // checked_array says what is wrong
    if (!error.matches(PyExc_Exception)) throw;  // KeyboardInterrupt
    return {};
  }
}

nb::module_ module_for(const char* name, const char* extra) {
  try {
    return nb::module_::import_(name);
  } catch (const nb::python_error& error) {
    if (!error.matches(PyExc_ModuleNotFoundError)) throw;
    throw nb::import_error(
        fmt::format("{} is not installed: pip install 'placegraph[{}]'", name, extra).c_str());
  }
}

}  // namespace placegraph::python
