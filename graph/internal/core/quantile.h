#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace placegraph {

/// The value that the share `share` of [0, 1] of the others lies below, rounded down to one of
/// them; at least one value needed.
inline double quantile_of(std::vector<double> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace placegraph
