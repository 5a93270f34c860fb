#include <placegraph/eval/errors/statistics.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

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
  std::vector<double> sorted = errors;
  std::sort(sorted.begin(), sorted.end());
  Statistics s;
  s.count = static_cast<int>(sorted.size());
  double sum = 0;
  for (const double e : sorted) {
    sum += e;
    s.sse += e * e;
  }
  s.mean = sum / s.count;
  s.rmse = std::sqrt(s.sse / s.count);
  double squares = 0;
  for (const double e : sorted) squares += (e - s.mean) * (e - s.mean);
  s.std_dev = std::sqrt(squares / s.count);
  s.median = quantile(sorted, 0.5);
  s.min = sorted.front();
  s.max = sorted.back();
  s.p75 = quantile(sorted, 0.75);
  s.p90 = quantile(sorted, 0.90);
  s.p95 = quantile(sorted, 0.95);
  s.p99 = quantile(sorted, 0.99);
  return s;
}

}  // namespace placegraph
