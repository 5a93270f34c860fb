#pragma once
#include <placegraph/eval/uncertainty/error_series.h>
#include <placegraph/eval/uncertainty/confidence_interval.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Interval of the mean over all errors of all series of one drive, as t_rel and r_rel are.
///
/// The true value is the expectation of the figure over estimates of the same drive by the same
/// system. The interval is Student's, on a logarithmic scale where no error is negative: figures of
/// few independent errors are skewed. Its width comes from the scatter along the drive, by an
/// orthonormal series variance (Müller 2007; Lazarus et al. 2018) whose half waves hold at least
/// two of the longest stretches and eight times the length over which errors are correlated.
/// Outcome: kTooFewData if the drive holds fewer than four disjoint stretches of the longest, or
/// fewer than 25 independent errors of the shortest; kDegenerate if the errors are all equal.
/// Throws ArgumentError if ErrorSeries::check() does, or for a level outside (0, 1).
[[nodiscard]] ConfidenceInterval interval_of_mean(const std::vector<ErrorSeries>& series,
                                                  double level = 0.95);
/// Interval of the root of the mean square over all errors; as interval_of_mean().
[[nodiscard]] ConfidenceInterval interval_of_rmse(const std::vector<ErrorSeries>& series,
                                                  double level = 0.95);
/// Interval of the median over all errors; as interval_of_mean().
/// It lies between two quantiles of the errors (Woodruff 1952).
[[nodiscard]] ConfidenceInterval interval_of_median(const std::vector<ErrorSeries>& series,
                                                    double level = 0.95);

}  // namespace placegraph
