#include <fmt/format.h>
#include <placegraph/eval/uncertainty/run_interval.h>
#include <placegraph/eval/uncertainty/run_statistics.h>
#include <placegraph/eval/uncertainty/student_t.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ranges>

namespace placegraph {

RunStatistics statistics_of_runs(const std::vector<double>& figures) {
  require(!figures.empty(), "no figure of any run");
  RunStatistics result;
  result.runs = static_cast<int>(figures.size());
  for (const double figure : figures) {
    require(std::isfinite(figure) && figure >= 0,
            fmt::format("the figure of a run is {}, not a number of 0 or more", figure));
    result.mean += figure / result.runs;
  }
  double squares = 0;
  for (const double figure : figures) squares += (figure - result.mean) * (figure - result.mean);
  if (result.runs > 1 && result.mean > 0)
    result.relative = std::sqrt(squares / (result.runs - 1)) / result.mean;
  result.outcome =
      result.runs >= kFewestRuns
          ? Outcome::ok()
          : Outcome::failure(Outcome::Code::kTooFewData,
                             fmt::format("{} run{}: {} are needed", result.runs,
                                         result.runs == 1 ? "" : "s", kFewestRuns));
  return result;
}

ConfidenceInterval interval_of_runs(const std::vector<double>& figures, double level) {
  require(level > 0 && level < 1, "the level of an interval is between 0 and 1");
  const RunStatistics runs = statistics_of_runs(figures);
  ConfidenceInterval interval;
  interval.outcome = runs.outcome;
  interval.estimate = runs.mean;
  interval.level = level;
  interval.degrees_freedom = runs.runs - 1;
  interval.of = "repeated runs";
  if (!interval.outcome) return interval;
  // Rounding of equal figures.
  if (runs.relative < 1e-12) {
    interval.outcome = Outcome::failure(Outcome::Code::kDegenerate,
                                        fmt::format("all {} runs are equal", runs.runs));
    return interval;
  }
  const double half = student_t_quantile(0.5 + 0.5 * level, interval.degrees_freedom) *
                      std::sqrt(runs.log_variance());
  interval.low = runs.mean * std::exp(-half);
  interval.high = runs.mean * std::exp(half);
  return interval;
}

void PowerOptions::check() const {
  require(worse > 0, "the effect to be found must be positive");
  require(power > 0 && power < 1, "the power is between 0 and 1");
  require(level > 0 && level < 1, "the level of a test is between 0 and 1");
}

/// The relative scatter that stays below it with that confidence (Browne 1995).
static double upper_limit_of_scatter(const RunStatistics& runs, double confidence) {
  const int dof = runs.runs - 1;
  return runs.relative * std::sqrt(dof / chi_squared_quantile(1 - confidence, dof));
}

RunsNeeded runs_needed(const std::vector<double>& baseline, const PowerOptions& options) {
  options.check();
  const RunStatistics runs = statistics_of_runs(baseline);
  RunsNeeded result{runs.outcome, 0};
  if (!result.outcome) return result;
  const double scatter = upper_limit_of_scatter(runs, options.power);
  const auto enough = [&](int n) {
    const double dof = 2.0 * (n - 1), deviations = student_t_quantile(1 - options.level, dof) +
                                                   student_t_quantile(options.power, dof);
    return 2 * std::pow(scatter * deviations / std::log1p(options.worse), 2) <= n;
  };
  // Nobody makes a million runs; an int holds them.
  const auto numbers = std::views::iota(kFewestRuns, 1000000);
  result.runs = *std::ranges::partition_point(numbers, std::not_fn(enough));
  return result;
}

}  // namespace placegraph
