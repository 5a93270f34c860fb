#pragma once
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// What whoever uses data should know of how they were read: what was left out and why, and what is
/// odd about their numbers and what to try.
struct DataNote {
  std::string text;           ///< one line
  bool doubts_scale = false;  ///< lengths may be wrong: a result is not to be called metric
};

}  // namespace placegraph
