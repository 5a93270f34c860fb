#include <placegraph/eval/trajectory/statistics.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

Statistics statistics_of(const std::vector<double>& errors) {
  require(!errors.empty(), "statistics of an empty list");
  std::vector<double> sorted = errors;
  std::sort(sorted.begin(), sorted.end());
  Statistics s;
  s.count = static_cast<int>(sorted.size());
  double sum = 0, squares = 0;
  for (const double e : sorted) {
    sum += e;
    squares += e * e;
  }
  s.mean = sum / s.count;
  s.rmse = std::sqrt(squares / s.count);
  const std::size_t half = sorted.size() / 2;
  s.median = sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
  s.max = sorted.back();
  return s;
}

}  // namespace placegraph
