#pragma once
#include <vector>

#include "python/src/bindings.h"

namespace placegraph::python {

/// Values that become a tuple of Python: a property that gave a list would take what is assigned to
/// an element without a word, and lose it.
template <class T>
struct TupleOf {
  std::vector<T> values;
};
template <class T>
TupleOf(std::vector<T>) -> TupleOf<T>;

/// The getter of a property that gives a member of a class as a tuple.
template <class Class, class T>
auto as_tuple(std::vector<T> Class::*member) {
  return [member](const Class& c) { return TupleOf<T>{c.*member}; };
}

/// The same of what a function returns.
template <class Class, class T>
auto as_tuple(std::vector<T> (*function)(const Class&)) {
  return [function](const Class& c) { return TupleOf<T>{function(c)}; };
}

}  // namespace placegraph::python

namespace nanobind::detail {

template <class T>
struct type_caster<placegraph::python::TupleOf<T>> {
  using Tuple = placegraph::python::TupleOf<T>;
  NB_TYPE_CASTER(Tuple, const_name("tuple[") + make_caster<T>::Name + const_name(", ...]"))

  bool from_python(handle, uint8_t, cleanup_list*) noexcept { return false; }

  static handle from_cpp(const Tuple& tuple, rv_policy, cleanup_list* cleanup) noexcept {
    object made = steal(PyTuple_New(static_cast<Py_ssize_t>(tuple.values.size())));
    if (!made.is_valid()) return {};
    for (std::size_t i = 0; i < tuple.values.size(); ++i) {
      const handle element = make_caster<T>::from_cpp(tuple.values[i], rv_policy::copy, cleanup);
      if (!element.is_valid()) return {};
      PyTuple_SET_ITEM(made.ptr(), static_cast<Py_ssize_t>(i), element.ptr());
    }
    return made.release();
  }
};

}  // namespace nanobind::detail
