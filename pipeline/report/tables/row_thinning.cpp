#include <placegraph/pipeline/report/tables/row_thinning.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <set>

namespace placegraph::report {
namespace {

/// One value of a series over the rows, as shares of the range of the series.
using Shares = std::vector<float>;

/// Values without gaps, which take the value before, and where there are values.
void put_shares(const RowSeries& series, std::size_t count, std::vector<Shares>& shares) {
  float range = 0;
  const std::size_t first = shares.size();
  for (std::size_t k = 0; k < series.width; ++k) {
    Shares& share = shares.emplace_back(count);
    float least = std::numeric_limits<float>::infinity(), greatest = -least, last = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const float value = series.values[series.stride * i + k];
      if (std::isfinite(value)) {
        last = value;
        least = std::min(least, value);
        greatest = std::max(greatest, value);
      }
      share[i] = last;
    }
    if (greatest > least) range = std::max(range, greatest - least);
  }
  for (std::size_t k = first; k < shares.size() && range > 0; ++k)
    for (float& value : shares[k]) value /= range;
  Shares& known = shares.emplace_back(count);
  for (std::size_t i = 0; i < count; ++i)
    known[i] = std::isfinite(series.values[series.stride * i]) ? 1.0f : 0.0f;
}

/// Rows between two kept ones, with that which lies farthest from the line between them.
struct Stretch {
  std::size_t begin = 0, end = 0, farthest = 0;
  float distance = 0;
  bool operator<(const Stretch& other) const {
    return distance != other.distance ? distance < other.distance : begin > other.begin;
  }
};

Stretch stretch_of(const std::vector<Shares>& shares, std::size_t begin, std::size_t end) {
  Stretch stretch{begin, end, begin, -1};
  for (const Shares& share : shares)
    for (std::size_t i = begin + 1; i < end; ++i) {
      const float along = static_cast<float>(i - begin) / static_cast<float>(end - begin);
      const float distance =
          std::abs(share[i] - (share[begin] + along * (share[end] - share[begin])));
      if (distance > stretch.distance) stretch.distance = distance, stretch.farthest = i;
    }
  return stretch;
}

}  // namespace

std::vector<std::size_t> even_rows(std::size_t count, std::size_t most) {
  std::vector<std::size_t> rows;
  const std::size_t kept = std::min(count, most);
  for (std::size_t i = 0; i < kept; ++i)
    rows.push_back(kept == 1 ? 0 : i * (count - 1) / (kept - 1));
  return rows;
}

std::vector<std::size_t> chosen_rows(std::size_t count, const std::vector<RowSeries>& series,
                                     const std::vector<std::size_t>& wanted, std::size_t most) {
  if (count <= most) return even_rows(count, count);
  std::vector<Shares> shares;
  for (const RowSeries& each : series) put_shares(each, count, shares);
  std::set<std::size_t> kept;
  for (const std::size_t row : even_rows(count, std::max<std::size_t>(2, most / 8)))
    kept.insert(row);
  for (const std::size_t i : even_rows(wanted.size(), most / 2))
    if (kept.size() < most) kept.insert(wanted[i]);
  std::priority_queue<Stretch> stretches;
  const auto put = [&](std::size_t begin, std::size_t end) {
    if (end > begin + 1) stretches.push(stretch_of(shares, begin, end));
  };
  for (auto at = kept.begin(); std::next(at) != kept.end(); ++at) put(*at, *std::next(at));
  while (kept.size() < most && !stretches.empty()) {
    const Stretch stretch = stretches.top();
    stretches.pop();
    if (!(stretch.distance > 0)) break;
    kept.insert(stretch.farthest);
    put(stretch.begin, stretch.farthest);
    put(stretch.farthest, stretch.end);
  }
  return {kept.begin(), kept.end()};
}

}  // namespace placegraph::report
