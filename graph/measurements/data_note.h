#pragma once
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// A remark about input data.
/// It names the data that were left out and the reason, or the numbers that are suspicious and a
/// possible remedy.
struct DataNote {
  std::string text;           ///< one line
  bool doubts_scale = false;  ///< lengths may be wrong: results must not be called metric
};

}  // namespace placegraph
