#include "apps/run/stamp_spacing.h"

#include <placegraph/graph/core/time.h>

#include <algorithm>
#include <cmath>

namespace placegraph::apps {

StampSpacing stamp_spacing(const std::vector<std::int64_t>& stamps_ns) {
  constexpr double kGap = 1.5;  // times the median: the next whole number of steps is two
  StampSpacing spacing;
  if (stamps_ns.size() < 2) return spacing;
  std::vector<double> distances_s;
  for (std::size_t i = 1; i < stamps_ns.size(); ++i)
    distances_s.push_back(seconds(stamps_ns[i - 1], stamps_ns[i]));
  std::vector<double> sorted_s = distances_s;
  std::ranges::sort(sorted_s);
  spacing.least_s = sorted_s.front();
  spacing.greatest_s = sorted_s.back();
  spacing.median_s = sorted_s[sorted_s.size() / 2];
  for (std::size_t i = 0; i < distances_s.size(); ++i) {
    if (!(distances_s[i] > kGap * spacing.median_s)) continue;
    spacing.gaps.push_back({i, distances_s[i]});
    spacing.missing +=
        static_cast<std::size_t>(std::llround(distances_s[i] / spacing.median_s)) - 1;
  }
  return spacing;
}

}  // namespace placegraph::apps
