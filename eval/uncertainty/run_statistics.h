#pragma once
#include <placegraph/graph/core/outcome.h>

#include <vector>

namespace placegraph {

/// The mean of a figure over runs and its relative scatter.
struct RunStatistics {
  Outcome outcome;      ///< kTooFewData: fewer than kFewestRuns
  int runs = 0;
  double mean = 0;
  double relative = 0;  ///< standard deviation of one run over the mean; only from two runs on

  /// Variance of the logarithm of the mean, to first order.
  double log_variance() const { return relative * relative / runs; }
};

/// Throws ArgumentError for no figure, and for one that is negative or not finite.
RunStatistics statistics_of_runs(const std::vector<double>& figures);

}  // namespace placegraph
