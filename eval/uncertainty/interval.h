#pragma once
#include <placegraph/graph/core/outcome.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Where the true value of a figure lies: its expectation over estimates of the same kind.
struct Interval {
  /// kTooFewData: the data hold too few independent errors or runs; kDegenerate: they do not vary.
  Outcome outcome;
  double estimate = 0;         ///< the figure, in its unit; filled without an interval, too
  double low = 0, high = 0;    ///< in the same unit; only if outcome
  double level = 0.95;         ///< probability that the interval holds the true value
  double degrees_freedom = 0;  ///< of Student's distribution from which the interval is taken
  std::string of;              ///< "this drive's errors" or "repeated runs"
};

/// An interval in a line: "0.9123, 95 % interval 0.8012 to 1.039 (repeated runs)", or the reason.
std::string to_text(const Interval& interval);

}  // namespace placegraph
