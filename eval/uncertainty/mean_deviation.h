#pragma once
#include <placegraph/eval/uncertainty/error_series.h>
#include <placegraph/graph/core/outcome.h>

#include <functional>
#include <vector>

namespace placegraph {

/// How far the mean over correlated errors may be from its expectation.
struct MeanDeviation {
  Outcome outcome;      ///< kTooFewData, kDegenerate: as ConfidenceInterval
  double mean = 0;      ///< of the terms of all errors of all series
  double sigma = 0;     ///< standard deviation of the mean; only if outcome
  int waves = 0;        ///< degrees of freedom of sigma
};

/// Estimates the deviation of the mean of a term of each error, from one drive.
///
/// Orthonormal series variance (Müller 2007; Lazarus, Lewis, Stock and Watson 2018): the terms of
/// each series, less their mean, are projected on the first cosines along it. Where they are
/// uncorrelated beyond half a wave, each projection has the deviation of the mean and is
/// independent of it and of the others, so that Student's distribution holds however few they are.
/// Half a wave holds two of the longest stretches and is eight times as long as the errors of the
/// shortest stretches are correlated. Long stretches attenuate short waves, and the ends of a drive
/// are in fewer stretches than its middle: projections are divided by what independent errors of
/// single frames would make of them. Errors of longer correlation than that (a scale that drifts
/// from its start) show as too few independent errors and get no deviation. Each series is
/// checked.
[[nodiscard]] MeanDeviation deviation_of_mean(
    const std::vector<ErrorSeries>& series,
    const std::function<double(double)>& term = [](double error) { return error; });

}  // namespace placegraph
