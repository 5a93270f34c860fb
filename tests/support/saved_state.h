#pragma once
#include <placegraph/graph/state_archive.h>

namespace placegraph::test {

/// The object that goes on from the saved state of another one. `fresh` has the same options.
template <class T>
T resumed(T& interrupted, T fresh) {
  StateWriter writer;
  writer(interrupted);
  StateReader reader(writer.written());
  reader(fresh);
  reader.end();
  return fresh;
}

}  // namespace placegraph::test
