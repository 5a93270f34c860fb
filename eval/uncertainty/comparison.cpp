#include <fmt/format.h>
#include <placegraph/eval/uncertainty/comparison.h>
#include <placegraph/eval/uncertainty/mean_deviation.h>
#include <placegraph/eval/uncertainty/run_interval.h>
#include <placegraph/eval/uncertainty/run_statistics.h>
#include <placegraph/eval/uncertainty/student_t.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

// Rounding of a relative scatter that is none.
constexpr double kNoScatter = 1e-12;

/// The logarithm of a ratio of figures, Student distributed about its expectation.
struct LogRatio {
  double value, sigma, degrees_freedom;
};

void write_sentence(const ComparisonOptions& options, Comparison& result) {
  const std::string unit = options.unit.empty() ? "" : " " + options.unit;
  const std::string interval =
      fmt::format("{:g} % interval of the ratio {:.3g} to {:.3g}", 100 * options.level,
                  result.ratio.low, result.ratio.high);
  const std::string both =
      fmt::format("{} {:.4g} and {:.4g}{}", options.figure, result.first, result.second, unit);
  switch (result.difference) {
    case Difference::kUnknown:
      result.sentence = fmt::format("{} of {} and {} cannot be compared: {}", options.figure,
                                    options.first, options.second, result.outcome.reason);
      return;
    case Difference::kNone:
      result.sentence = fmt::format("no difference between {} and {} is found: {}, {}",
                                    options.first, options.second, both, interval);
      return;
    case Difference::kBelowNoise:
      result.sentence = fmt::format(
          "the difference between {} and {}, {:.3g}{}, is within the noise of the truth, "
          "{:.3g}{}: {}",
          options.first, options.second, std::abs(result.change()), unit, options.noise_floor,
          unit, both);
      return;
    case Difference::kBetter:
    case Difference::kWorse:
      result.sentence = fmt::format(
          "{} is {:.3g} % {} than {}: {} {:.4g} to {:.4g}{}, {}", options.second,
          100 * std::abs(result.second / result.first - 1),
          result.difference == Difference::kWorse ? "worse" : "better", options.first,
          options.figure, result.first, result.second, unit, interval);
  }
}

void fail(Outcome::Code code, const std::string& reason, const ComparisonOptions& options,
          Comparison& result) {
  result.outcome = result.ratio.outcome = Outcome::failure(code, reason);
  write_sentence(options, result);
}

double half_width(const LogRatio& ratio, double level) {
  return ratio.sigma * student_t_quantile(0.5 + 0.5 * level, ratio.degrees_freedom);
}

/// The second mean over the first, by Welch's or Student's test, whichever has the wider interval:
/// few runs that all miss what happens in one run of five mislead the first, systems of different
/// scatter the second.
LogRatio ratio_of_means(const RunStatistics& a, const RunStatistics& b, double level) {
  const double value = std::log(b.mean / a.mean);
  const double of_a = a.log_variance(), of_b = b.log_variance(), both = of_a + of_b;
  const LogRatio welch{value, std::sqrt(both),
                       both * both / (of_a * of_a / (a.runs - 1) + of_b * of_b / (b.runs - 1))};
  const int dof = a.runs + b.runs - 2;
  const double pooled = ((a.runs - 1) * a.runs * of_a + (b.runs - 1) * b.runs * of_b) / dof;
  const LogRatio student{value, std::sqrt(pooled / a.runs + pooled / b.runs),
                         static_cast<double>(dof)};
  return half_width(welch, level) >= half_width(student, level) ? welch : student;
}

void conclude(const LogRatio& ratio, const ComparisonOptions& options, Comparison& result) {
  result.outcome = result.ratio.outcome = Outcome::ok();
  result.ratio.estimate = std::exp(ratio.value);
  result.ratio.level = options.level;
  result.ratio.degrees_freedom = ratio.degrees_freedom;
  const double half = half_width(ratio, options.level);
  result.ratio.low = std::exp(ratio.value - half);
  result.ratio.high = std::exp(ratio.value + half);
  if (ratio.sigma > 0) {
    result.p_worse = student_t_tail(ratio.value / ratio.sigma, ratio.degrees_freedom);
    result.p_value =
        2 * student_t_tail(std::abs(ratio.value / ratio.sigma), ratio.degrees_freedom);
  }
  if (result.ratio.low <= 1 && result.ratio.high >= 1)
    result.difference = Difference::kNone;
  else if (std::abs(result.change()) <= options.noise_floor)
    result.difference = Difference::kBelowNoise;
  else
    result.difference = ratio.value > 0 ? Difference::kWorse : Difference::kBetter;
  write_sentence(options, result);
}

/// Two figures without scatter: the same, or no interval.
void conclude_without_scatter(double degrees_freedom, const ComparisonOptions& options,
                              Comparison& result) {
  const bool same = std::abs(result.change()) <= kNoScatter * std::abs(result.first);
  if (same)
    conclude({0, 0, degrees_freedom}, options, result);
  else
    fail(Outcome::Code::kDegenerate, "their ratio does not vary: it has no interval", options,
         result);
}

/// The errors of two series over the same stretches.
struct CommonErrors {
  ErrorSeries first, second;
  int left_out = 0;
};

CommonErrors common_errors(const ErrorSeries& first, const ErrorSeries& second) {
  CommonErrors common{{first.stretch, {}}, {second.stretch, {}}, 0};
  auto a = first.errors.begin();
  auto b = second.errors.begin();
  const auto before = [](const StretchError& x, const StretchError& y) {
    return std::pair(x.first_frame, x.last_frame) < std::pair(y.first_frame, y.last_frame);
  };
  while (a != first.errors.end() && b != second.errors.end()) {
    if (before(*a, *b)) {
      ++a;
    } else if (before(*b, *a)) {
      ++b;
    } else {
      require(a->error >= 0 && b->error >= 0, "errors that are compared are not negative");
      common.first.errors.push_back(*a++);
      common.second.errors.push_back(*b++);
    }
  }
  common.left_out = static_cast<int>(first.errors.size() + second.errors.size() -
                                     2 * common.first.errors.size());
  return common;
}

std::vector<CommonErrors> common_series(const std::vector<ErrorSeries>& first,
                                        const std::vector<ErrorSeries>& second,
                                        Comparison& result) {
  std::vector<CommonErrors> all;
  const auto errors_of = [](const std::vector<ErrorSeries>& series) {
    int count = 0;
    for (const ErrorSeries& one : series) {
      one.check();
      count += static_cast<int>(one.errors.size());
    }
    return count;
  };
  result.left_out = errors_of(first) + errors_of(second);
  for (const ErrorSeries& a : first) {
    const auto b = std::find_if(second.begin(), second.end(),
                                [&a](const ErrorSeries& s) { return s.stretch == a.stretch; });
    if (b == second.end()) continue;
    CommonErrors common = common_errors(a, *b);
    if (common.first.errors.empty()) continue;
    result.common += static_cast<int>(common.first.errors.size());
    all.push_back(std::move(common));
  }
  result.left_out -= 2 * result.common;
  return all;
}

}  // namespace

void ComparisonOptions::check() const {
  require(level > 0 && level < 1, "the level of an interval is between 0 and 1");
  require(std::isfinite(noise_floor) && noise_floor >= 0,
          "the noise of the truth is a number of 0 or more");
}

const char* to_string(Difference difference) {
  switch (difference) {
    case Difference::kNone: return "none";
    case Difference::kBelowNoise: return "below noise";
    case Difference::kBetter: return "better";
    case Difference::kWorse: return "worse";
    case Difference::kUnknown: break;
  }
  return "unknown";
}

Comparison compare_series(const std::vector<ErrorSeries>& first,
                          const std::vector<ErrorSeries>& second, SeriesFigure figure,
                          const ComparisonOptions& options) {
  options.check();
  Comparison result;
  result.ratio.of = "this drive's errors";
  const std::vector<CommonErrors> common = common_series(first, second, result);
  if (common.empty()) {
    fail(Outcome::Code::kInconsistent, "they have no stretch in common", options, result);
    return result;
  }
  const auto value = [figure](const StretchError& e) {
    return figure == SeriesFigure::kMean ? e.error : e.error * e.error;
  };
  double sum_a = 0, sum_b = 0;
  for (const CommonErrors& one : common) {
    for (const StretchError& e : one.first.errors) sum_a += value(e) / result.common;
    for (const StretchError& e : one.second.errors) sum_b += value(e) / result.common;
  }
  const double power = figure == SeriesFigure::kMean ? 1 : 0.5;
  result.first = std::pow(sum_a, power);
  result.second = std::pow(sum_b, power);
  if ((sum_a == 0) != (sum_b == 0)) {
    fail(Outcome::Code::kDegenerate, "one of them has no error at all", options, result);
    return result;
  }
  // To first order, what each pair of errors adds to the logarithm of the ratio.
  std::vector<ErrorSeries> influence;
  double largest = 0;
  for (const CommonErrors& one : common) {
    influence.push_back(one.first);
    for (std::size_t i = 0; i < one.first.errors.size() && sum_a > 0; ++i) {
      double& error = influence.back().errors[i].error;
      error = power * (value(one.second.errors[i]) / sum_b - value(one.first.errors[i]) / sum_a);
      largest = std::max(largest, std::abs(error));
    }
  }
  const MeanDeviation deviation = deviation_of_mean(influence);
  if (largest < kNoScatter)
    conclude_without_scatter(1, options, result);
  else if (!deviation.outcome)
    fail(deviation.outcome.code, deviation.outcome.reason, options, result);
  else
    conclude({std::log(result.second / result.first), deviation.sigma,
              static_cast<double>(deviation.waves)},
             options, result);
  return result;
}

Comparison compare_runs(const std::vector<double>& first, const std::vector<double>& second,
                        const ComparisonOptions& options) {
  options.check();
  const RunStatistics a = statistics_of_runs(first), b = statistics_of_runs(second);
  Comparison result;
  result.ratio.of = "repeated runs";
  result.first = a.mean;
  result.second = b.mean;
  result.common = a.runs;
  if (!a.outcome || !b.outcome) {
    const std::string& name = !a.outcome ? options.first : options.second;
    fail(Outcome::Code::kTooFewData,
         fmt::format("{} has {}", name, (!a.outcome ? a : b).outcome.reason), options, result);
  } else if (std::sqrt(a.log_variance() + b.log_variance()) < kNoScatter) {
    conclude_without_scatter(a.runs + b.runs - 2, options, result);
  } else if (a.mean == 0 || b.mean == 0) {
    fail(Outcome::Code::kDegenerate, "one of them has no error at all", options, result);
  } else {
    conclude(ratio_of_means(a, b, options.level), options, result);
  }
  return result;
}

Comparison compare_paired_runs(const std::vector<double>& first,
                               const std::vector<double>& second,
                               const ComparisonOptions& options) {
  options.check();
  require(first.size() == second.size(),
          fmt::format("pairs of runs: {} of the first, {} of the second", first.size(),
                      second.size()));
  const RunStatistics runs = statistics_of_runs(first);
  static_cast<void>(statistics_of_runs(second));
  std::vector<double> logs;
  double log_first = 0, mean = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    require(first[i] > 0 && second[i] > 0, "figures of pairs of runs are positive");
    logs.push_back(std::log(second[i] / first[i]));
    log_first += std::log(first[i]) / runs.runs;
    mean += logs.back() / runs.runs;
  }
  double squares = 0;
  for (const double log : logs) squares += (log - mean) * (log - mean);
  Comparison result;
  result.ratio.of = "repeated runs";
  result.first = std::exp(log_first);
  result.second = std::exp(log_first + mean);
  result.common = runs.runs;
  if (!runs.outcome)
    fail(runs.outcome.code, "in pairs, " + runs.outcome.reason, options, result);
  else if (const double sigma = std::sqrt(squares / (runs.runs - 1) / runs.runs);
           sigma < kNoScatter)
    conclude_without_scatter(runs.runs - 1, options, result);
  else
    conclude({mean, sigma, static_cast<double>(runs.runs - 1)}, options, result);
  return result;
}

}  // namespace placegraph
