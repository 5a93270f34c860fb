#pragma once
#include <placegraph/graph/core/outcome.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Where the true value of a figure lies.
/// It is the figure's expectation over estimates of the same kind.
struct ConfidenceInterval {
  /// kTooFewData: the data hold too few independent errors or runs; kDegenerate: they do not vary.
  Outcome outcome;
  double estimate = 0;         ///< the figure, in its unit; filled without an interval, too
  double low = 0, high = 0;    ///< in the same unit; only if outcome
  double level = 0.95;         ///< probability that the interval holds the true value
  double degrees_freedom = 0;  ///< of Student's distribution from which the interval is taken
  std::string of;              ///< "this drive's errors" or "repeated runs"
};

/// An interval in a line, or why there is none.
/// "0.9123, 95 % interval 0.8012 to 1.039 (repeated runs)".
std::string to_text(const ConfidenceInterval& interval);

}  // namespace placegraph
