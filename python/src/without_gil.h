#pragma once
#include <nanobind/nanobind.h>
#include <placegraph/graph/core/parallel.h>

namespace placegraph::python {

/// Raises what Python's signal handlers raise, as KeyboardInterrupt for Ctrl-C. In other threads
/// than Python's main one there is nothing to raise.
inline void check_signals() {
  const nanobind::gil_scoped_acquire gil;
  if (PyErr_CheckSignals() != 0) throw nanobind::python_error();
}

/// Releases the GIL for a call into the library, which Ctrl-C ends.
class WithoutGil {
 private:
  nanobind::gil_scoped_release released_;
  InterruptionScope scope_{&check_signals};
};

}  // namespace placegraph::python
