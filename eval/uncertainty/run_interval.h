#pragma once
#include <placegraph/eval/uncertainty/confidence_interval.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Runs without which their scatter is not known.
/// The interval of four runs is more than twice as wide as that of ten. Chosen.
inline constexpr int kFewestRuns = 5;

/// ConfidenceInterval of a figure of repeated runs: of its expectation over runs or seeds.
///
/// `figures` are one figure of each run (an ATE, any error), the estimate is their mean. The
/// interval is Student's on a logarithmic scale, on which figures that scatter by half of their
/// mean or more are less skewed. Outcome: kTooFewData for fewer than kFewestRuns runs, kDegenerate
/// if they are all equal (runs that repeat the same computation). Throws ArgumentError for a figure
/// that is negative or not finite, for none, and for a level outside (0, 1).
[[nodiscard]] ConfidenceInterval interval_of_runs(const std::vector<double>& figures,
                                                  double level = 0.95);

/// What runs_needed() looks for.
struct PowerOptions {
  double worse = 0.10;  ///< relative effect that is to be found: 0.10 is 10 % worse
  double power = 0.80;  ///< probability of finding it
  double level = 0.05;  ///< probability of an alarm although there is no effect, one-sided
  /// Throws ArgumentError unless all are positive and the last two below 1.
  void check() const;
};

/// The number of runs that compare_runs() needs.
struct RunsNeeded {
  Outcome outcome;  ///< kTooFewData: fewer than kFewestRuns runs, from which no scatter is known
  int runs = 0;     ///< of each system, at least kFewestRuns; only if outcome
};

/// Runs that each of two systems needs for an effect to be found.
///
/// Both are taken to scatter by the upper limit of what the baseline's runs show, with the power as
/// its confidence (Browne 1995): few runs may miss what happens in one of five. At most a million.
/// Throws as interval_of_runs().
[[nodiscard]] RunsNeeded runs_needed(const std::vector<double>& baseline,
                                     const PowerOptions& options = {});

}  // namespace placegraph
