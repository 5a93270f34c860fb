#pragma once
#include <placegraph/eval/uncertainty/error_series.h>
#include <placegraph/graph/core/outcome.h>

#include <vector>

namespace placegraph {

/// How far the mean of correlated errors may be from its expectation.
struct MeanDeviation {
  Outcome outcome;      ///< kTooFewData, kDegenerate: as Interval
  double mean = 0;      ///< over all errors of all series
  double sigma = 0;     ///< standard deviation of the mean, estimated with `waves` degrees of freedom
  int waves = 0;        ///< number of waves whose squares sigma^2 is the mean of
};

/// Estimates the deviation of the mean from one drive, whose errors overlap and are correlated.
///
/// Orthonormal series variance (Müller 2007; Lazarus, Lewis, Stock and Watson 2018): the errors of
/// each series, less their mean, are projected on the first cosines along it. Where the errors are
/// uncorrelated beyond half a wave, each projection has the deviation of the mean and is
/// independent of it and of the others, so that Student's distribution holds however few they are.
/// Half a wave holds two of the longest stretches and is four times as long as the errors of the
/// shortest stretches are correlated. Long stretches attenuate short waves, and the ends of a drive
/// are in fewer stretches than its middle: projections are divided by what independent errors of
/// single frames would make of them. Errors of longer correlation than that (a scale that drifts
/// from its start) show as too few independent errors and get no deviation. Each series is
/// checked.
[[nodiscard]] MeanDeviation deviation_of_mean(const std::vector<ErrorSeries>& series);

}  // namespace placegraph
