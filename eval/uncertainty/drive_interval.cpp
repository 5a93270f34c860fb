#include <placegraph/eval/uncertainty/drive_interval.h>
#include <placegraph/eval/uncertainty/mean_deviation.h>
#include <placegraph/eval/uncertainty/student_t.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// All but estimate, low and high.
ConfidenceInterval interval_by(const MeanDeviation& deviation, double level) {
  require(level > 0 && level < 1, "the level of an interval is between 0 and 1");
  ConfidenceInterval interval;
  interval.outcome = deviation.outcome;
  interval.level = level;
  interval.degrees_freedom = deviation.waves;
  interval.of = "this drive's errors";
  return interval;
}

double half_width(const ConfidenceInterval& interval, double sigma) {
  return sigma * student_t_quantile(0.5 + 0.5 * interval.level, interval.degrees_freedom);
}

std::vector<double> sorted_errors(const std::vector<ErrorSeries>& series) {
  std::vector<double> values;
  for (const ErrorSeries& one : series)
    for (const StretchError& e : one.errors) values.push_back(e.error);
  std::sort(values.begin(), values.end());
  return values;
}

/// The mean of the two middle values where their number is even, as Statistics::median.
double median_of_sorted(const std::vector<double>& sorted) {
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}

}  // namespace

ConfidenceInterval interval_of_mean(const std::vector<ErrorSeries>& series, double level) {
  const MeanDeviation deviation = deviation_of_mean(series);
  ConfidenceInterval interval = interval_by(deviation, level);
  interval.estimate = deviation.mean;
  if (!interval.outcome) return interval;
  const double half = half_width(interval, deviation.sigma);
  if (sorted_errors(series).front() >= 0) {
    interval.low = deviation.mean * std::exp(-half / deviation.mean);
    interval.high = deviation.mean * std::exp(half / deviation.mean);
  } else {
    interval.low = deviation.mean - half;
    interval.high = deviation.mean + half;
  }
  return interval;
}

ConfidenceInterval interval_of_rmse(const std::vector<ErrorSeries>& series, double level) {
  const MeanDeviation squares = deviation_of_mean(series, [](double e) { return e * e; });
  ConfidenceInterval interval = interval_by(squares, level);
  interval.estimate = std::sqrt(squares.mean);
  if (!interval.outcome) return interval;
  // Of the logarithm of the root.
  const double half = 0.5 * half_width(interval, squares.sigma) / squares.mean;
  interval.low = interval.estimate * std::exp(-half);
  interval.high = interval.estimate * std::exp(half);
  return interval;
}

ConfidenceInterval interval_of_median(const std::vector<ErrorSeries>& series, double level) {
  require(!series.empty(), "no series of errors");
  for (const ErrorSeries& one : series) one.check();
  const std::vector<double> sorted = sorted_errors(series);
  const double median = median_of_sorted(sorted);
  const MeanDeviation below =
      deviation_of_mean(series, [median](double e) { return e < median ? 1.0 : 0.0; });
  ConfidenceInterval interval = interval_by(below, level);
  interval.estimate = median;
  if (!interval.outcome) return interval;
  const double half = half_width(interval, below.sigma);
  if (half >= 0.5) {
    interval.outcome = Outcome::failure(Outcome::Code::kTooFewData,
                                        "too few independent errors to bound their median");
    return interval;
  }
  const auto last = static_cast<double>(sorted.size() - 1);
  interval.low = sorted[static_cast<std::size_t>(std::floor((0.5 - half) * last))];
  interval.high = sorted[static_cast<std::size_t>(std::ceil((0.5 + half) * last))];
  return interval;
}

}  // namespace placegraph
