#pragma once
#include <functional>
#include <string>

#include "python/src/bindings.h"
#include "python/src/values/archive.h"

namespace placegraph::python {

/// The state of a pickle: the version of the package, and the bytes of the value.
nb::tuple pickled_state(const std::string& bytes);
/// The bytes in such a state. Throws ArgumentError, which names both versions, for a pickle of
/// another version of the package.
nb::bytes pickled_bytes(nb::handle state, nb::handle type);
/// Throws ArgumentError unless `version` is that of this package; `type` names what was pickled.
void require_own_version(const std::string& version, const std::string& type);

/// How values are hashed: by their numbers, or, because they can be changed, not at all.
enum class Hash { kByValue, kNone };

/// Lets a class behave as a value: pickle, copy, deepcopy, == and hash.
///
/// Two objects are equal if all that they store is, numbers by ==, but a NaN equals a NaN in the
/// same place.
template <class T, class... Extra>
void bind_value(nb::class_<T, Extra...>& c, Hash hash) {
  using Use = Writer::Use;
  c.def("__getstate__", [](const T& value) { return pickled_state(bytes_of(value, Use::kStored)); })
      .def(
          "__setstate__",
          [](T& self, nb::handle state) {
            const nb::bytes bytes = pickled_bytes(state, nb::type<T>());
            new (&self) T(value_of<T>({bytes.c_str(), bytes.size()}));
          },
          nb::arg("state").none())
      .def("__copy__", [](const T& value) { return T(value); })
      .def(
          "__deepcopy__", [](const T& value, nb::handle) { return T(value); }, nb::arg("memo"))
      .def(
          "__eq__",
          [](const T& value, nb::handle other) -> nb::object {
            if (!nb::isinstance<T>(other)) return nb::borrow(Py_NotImplemented);
            const T& compared = nb::cast<const T&>(other);
            return nb::bool_(&compared == &value ||
                             bytes_of(value, Use::kCompared) == bytes_of(compared, Use::kCompared));
          },
          nb::arg("other").none(), nb::sig("def __eq__(self, other: object, /) -> bool"));
  if (hash == Hash::kByValue)
    c.def("__hash__", [](const T& value) {
      const std::size_t found = std::hash<std::string>()(bytes_of(value, Use::kCompared));
      return static_cast<std::int64_t>(found >> 1);
    });
  else
    c.attr("__hash__") = nb::none();
}

}  // namespace placegraph::python
