#pragma once
#include <placegraph/eval/uncertainty/error_series.h>
#include <placegraph/eval/uncertainty/confidence_interval.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// How two systems are compared, and what the sentence calls them.
struct ComparisonOptions {
  double level = 0.95;  ///< of the interval; a difference counts if its ratio's leaves out 1
  /// What the noise of the truth adds to the figure, in its unit (TruthNoise): no smaller
  /// difference counts.
  double noise_floor = 0;
  std::string first = "A", second = "B";  ///< names of the systems
  std::string figure = "error", unit;     ///< name and unit of the figure: "t_rel", "%"
  /// Throws ArgumentError for a level outside (0, 1) and a floor that is negative or not finite.
  void check() const;
};

/// What a comparison says of the second system.
enum class Difference {
  kUnknown,     ///< the data allow no answer: see the outcome
  kNone,        ///< the interval of the ratio holds 1
  kBelowNoise,  ///< the difference is within the noise of the truth
  kBetter,      ///< the second has the smaller error
  kWorse,       ///< the second has the larger error
};
/// The name of a difference: "unknown", "none", "below noise", "better", "worse".
const char* to_string(Difference difference);

/// Two systems' figures, errors of any kind: smaller is better.
struct Comparison {
  /// As ConfidenceInterval; kInconsistent: the two have nothing in common.
  Outcome outcome;
  double first = 0;          ///< the figure of the first system
  double second = 0;         ///< the figure of the second one
  ConfidenceInterval ratio;            ///< second over first
  double p_value = 1;        ///< of a ratio of 1, two-sided; only if outcome
  double p_worse = 1;        ///< of the second being no worse, one-sided; only if outcome
  int common = 0;            ///< errors or runs of the first system that are compared
  int left_out = 0;          ///< errors of either system that the other one lacks
  Difference difference = Difference::kUnknown;  ///< what the interval and the floor decide
  /// "B is 12 % worse than A: t_rel 0.91 to 1.02 %, 95 % interval of the ratio 1.04 to 1.21".
  std::string sentence;

  /// second - first, in the unit of the figure.
  double change() const { return second - first; }
};

/// The figure of a drive's errors that is compared.
enum class SeriesFigure { kMean, kRmse };

/// Compares two estimates of one drive by the errors over the same stretches.
///
/// Errors are paired by their series' name and their two frames, so that what makes a part of the
/// drive hard for both cancels. The interval is that of drive_interval.h, of the logarithm of the
/// ratio. Outcome: kTooFewData as there, kDegenerate if the second's errors are a constant multiple
/// of the first's, kInconsistent if they have no stretch in common. Throws ArgumentError for a
/// negative error, and as ErrorSeries::check() and ComparisonOptions::check() do.
[[nodiscard]] Comparison compare_series(const std::vector<ErrorSeries>& first,
                                        const std::vector<ErrorSeries>& second,
                                        SeriesFigure figure,
                                        const ComparisonOptions& options = {});

/// Compares repeated runs of two systems, which need not be equally many.
///
/// Of the tests of unequal (Welch 1947) and of equal variances (Student 1908), on the logarithms of
/// the means, the one with the wider interval. Outcome:
/// kTooFewData if either has fewer than kFewestRuns runs, kDegenerate if neither varies and they
/// differ. Throws as interval_of_runs() and ComparisonOptions::check().
[[nodiscard]] Comparison compare_runs(const std::vector<double>& first,
                                      const std::vector<double>& second,
                                      const ComparisonOptions& options = {});

/// Compares runs in pairs of the same sequence or seed: entry i of both.
///
/// Student's test of the mean logarithm of the ratios: every pair has the same weight, of large
/// figures or small, and `first` and `second` are the geometric means. Outcome as compare_runs().
/// Throws ArgumentError for lists of different length and figures that are not positive.
[[nodiscard]] Comparison compare_paired_runs(const std::vector<double>& first,
                                             const std::vector<double>& second,
                                             const ComparisonOptions& options = {});

}  // namespace placegraph
