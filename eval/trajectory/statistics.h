#pragma once
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Statistics of a list of errors, in the unit of the list.
struct Statistics {
  double rmse = 0;    ///< root of the mean square
  double mean = 0;    ///< arithmetic mean
  double median = 0;  ///< mean of the two middle ones where their number is even
  double max = 0;     ///< the largest error
  int count = 0;      ///< number of errors
};

/// Computes the statistics of a list of errors. Throws ArgumentError if it is empty.
Statistics statistics_of(const std::vector<double>& errors);

}  // namespace placegraph
