#pragma once
#include <cstdint>

namespace [[gnu::visibility("default")]] placegraph {

/// Time from one stamp to another [s]; negative if `to_ns` is earlier.
inline double seconds(std::int64_t from_ns, std::int64_t to_ns) {
  return 1e-9 * static_cast<double>(to_ns - from_ns);
}

}  // namespace placegraph
