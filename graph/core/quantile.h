#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace placegraph {

/// The `share` quantile, `share` in [0, 1], rounded down to one of the values; needs at least one
/// value.
inline double quantile_of(std::vector<double> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace placegraph
