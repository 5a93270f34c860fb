#pragma once
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// A remark about data that were read, for those who use them.
/// It says what was left out and why, or what is odd about the numbers and what to try.
struct DataNote {
  std::string text;           ///< one line
  bool doubts_scale = false;  ///< lengths may be wrong: results must not be called metric
};

}  // namespace placegraph
