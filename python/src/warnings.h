#pragma once
#include <placegraph/graph/core/log.h>

#include "python/src/bindings.h"

namespace placegraph::python {

/// Makes warnings of the library those of Python; messages of other levels are left out.
inline LogSink python_warnings() {
  return [](LogLevel level, const std::string& message) {
    if (level != LogLevel::kWarning) return;
    const nb::gil_scoped_acquire gil;
    if (PyErr_WarnEx(PyExc_RuntimeWarning, message.c_str(), 1) != 0) throw nb::python_error();
  };
}

/// Makes what a reader notes of its input a warning of Python, whatever its level.
inline LogSink python_notes() {
  return [](LogLevel, const std::string& message) {
    python_warnings()(LogLevel::kWarning, message);
  };
}

}  // namespace placegraph::python
