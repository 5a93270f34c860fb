#include <placegraph/eval/errors/statistics.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

namespace {

/// The quantile of values of which those before `divided` are not above the others; moves it on.
double quantile_above(std::vector<double>& values, std::size_t& divided, double q) {
  const double place = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const auto at = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(divided), at(below), values.end());
  divided = below;
  if (below + 1 >= values.size()) return values[below];
  const double next = *std::min_element(at(below + 1), values.end());
  return values[below] + (place - static_cast<double>(below)) * (next - values[below]);
}

}  // namespace

double quantile(const std::vector<double>& sorted, double q) {
  require(!sorted.empty(), "quantile of an empty list");
  require(q >= 0 && q <= 1, "quantile: the share is outside [0, 1]");
  const double place = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  if (below + 1 >= sorted.size()) return sorted.back();
  const double share = place - static_cast<double>(below);
  return sorted[below] + share * (sorted[below + 1] - sorted[below]);
}

Statistics statistics_of(const std::vector<double>& errors) {
  require(!errors.empty(), "statistics of an empty list");
  Statistics s;
  s.count = static_cast<int>(errors.size());
  double sum = 0;
  for (const double e : errors) {
    sum += e;
    s.sse += e * e;
  }
  s.mean = sum / s.count;
  s.rmse = std::sqrt(s.sse / s.count);
  double squares = 0;
  for (const double e : errors) squares += (e - s.mean) * (e - s.mean);
  s.std_dev = std::sqrt(squares / s.count);
  const auto [least, greatest] = std::minmax_element(errors.begin(), errors.end());
  s.min = *least;
  s.max = *greatest;
  // Each quantile divides what is above the one before: linear in all.
  std::vector<double> values = errors;
  std::size_t divided = 0;
  for (const auto& [q, member] :
       {std::pair(0.5, &s.median), std::pair(0.75, &s.p75), std::pair(0.9, &s.p90),
        std::pair(0.95, &s.p95), std::pair(0.99, &s.p99)})
    *member = quantile_above(values, divided, q);
  return s;
}

Statistics signed_statistics_of(const std::vector<double>& errors) {
  std::vector<double> magnitudes = errors;
  for (double& error : magnitudes) error = std::abs(error);
  Statistics s = statistics_of(magnitudes);
  const Statistics with_signs = statistics_of(errors);
  s.mean = with_signs.mean;
  s.median = with_signs.median;
  s.std_dev = with_signs.std_dev;
  return s;
}

}  // namespace placegraph
