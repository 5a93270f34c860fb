#pragma once
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Statistics of a list of errors, in the unit of the list; `sse` in its square.
struct Statistics {
  double rmse = 0;                         ///< root of the mean square
  double mean = 0;                         ///< arithmetic mean
  double median = 0;                       ///< mean of the two middle ones if their number is even
  double std_dev = 0;                      ///< root of the mean square about the mean
  double min = 0;                          ///< the smallest error
  double max = 0;                          ///< the largest error
  double sse = 0;                          ///< sum of squares
  double p75 = 0;                          ///< three quarters are not larger, see quantile
  double p90 = 0;                          ///< nine tenths are not larger
  double p95 = 0;                          ///< 95 of a hundred are not larger
  double p99 = 0;                          ///< 99 of a hundred are not larger
  int count = 0;                           ///< number of errors
};

/// Computes the statistics of a list of errors. Throws ArgumentError if it is empty.
Statistics statistics_of(const std::vector<double>& errors);

/// Those of errors that have signs. Throws ArgumentError if the list is empty.
///
/// Mean, median and std_dev are of the errors; min, max and what so many are not larger than, of
/// their magnitudes.
Statistics signed_statistics_of(const std::vector<double>& errors);

/// The value below which the share `q` in [0, 1] of a sorted list lies.
///
/// Linear between the two nearest values (Hyndman and Fan 1996, type 7; numpy's default). Throws
/// ArgumentError if the list is empty.
double quantile(const std::vector<double>& sorted, double q);

}  // namespace placegraph
