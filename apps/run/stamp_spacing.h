#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace placegraph::apps {

/// Two neighbouring stamps that are farther apart than the others.
struct StampGap {
  std::size_t after = 0;  ///< index of the stamp before the gap
  double seconds = 0;
};

/// Distances between the stamps of a recording. All 0 for fewer than two stamps.
struct StampSpacing {
  double median_s = 0, least_s = 0, greatest_s = 0;
  std::vector<StampGap> gaps;  ///< gaps of more than one and a half times the median, in time order
  std::size_t missing = 0;     ///< stamps that would fill the gaps at the median distance
};

/// Precondition: increasing stamps [ns].
StampSpacing stamp_spacing(const std::vector<std::int64_t>& stamps_ns);

}  // namespace placegraph::apps
