#pragma once
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Of a list of errors; all in the unit of the list.
struct Statistics {
  double rmse = 0;
  double mean = 0;
  double median = 0;  ///< mean of the two middle ones where their number is even
  double max = 0;
  int count = 0;
};

/// Throws ArgumentError if `errors` is empty: there are no statistics of nothing.
Statistics statistics_of(const std::vector<double>& errors);

}  // namespace placegraph
