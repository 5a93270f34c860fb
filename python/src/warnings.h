#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/core/outcome.h>

#include <string>
#include <vector>

#include "python/src/bindings.h"

namespace placegraph::python {

/// The class `placegraph.Doubt` of the package's warnings.
PyObject* doubt_class();

/// Warns with placegraph.Doubt; throws if the warning is an error. Call it with the GIL.
inline void warn(const std::string& text) {
  if (PyErr_WarnEx(doubt_class(), text.c_str(), 2) != 0) throw nb::python_error();
}

/// The texts of doubts.
inline std::vector<std::string> texts_of(const std::vector<Doubt>& doubts) {
  std::vector<std::string> texts;
  for (const Doubt& doubt : doubts) texts.push_back(doubt.text);
  return texts;
}

/// Makes warnings of the library those of Python; messages of other levels are left out.
inline LogSink python_warnings() {
  return [](LogLevel level, const std::string& message) {
    if (level != LogLevel::kWarning) return;
    const nb::gil_scoped_acquire gil;
    warn(message);
  };
}

/// Makes what a reader notes of its input a warning of Python, whatever its level.
inline LogSink python_notes() {
  return [](LogLevel, const std::string& message) {
    python_warnings()(LogLevel::kWarning, message);
  };
}

}  // namespace placegraph::python
