#pragma once
#include <placegraph/graph/core/outcome.h>

namespace placegraph {

/// Result of the optimization of a sliding window.
struct WindowSummary {
  Outcome outcome;
  double cost_initial = 0, cost_final = 0;  ///< half the robust sum of squares
  int iterations = 0;
};

}  // namespace placegraph
