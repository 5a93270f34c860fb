#pragma once
#include <placegraph/eval/edges/truth_noise.h>
#include <placegraph/eval/trajectory/result.h>
#include <placegraph/eval/uncertainty/comparison.h>

#include <map>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Intervals of the figures of one estimate, from the scatter of its errors along the drive.
///
/// Of t_rel, r_rel and every RPE; an ATE of one run has none, and says so.
[[nodiscard]] std::vector<FigureInterval> intervals_of_drive(const EvaluationResult& result,
                                                             double level = 0.95);

/// Intervals of the figures of repeated runs of one system over one drive.
///
/// A run without figures leaves no figure an interval: a system that fails where it is hard would
/// have the better mean.
[[nodiscard]] std::vector<FigureInterval> intervals_of_repeated_runs(
    const std::vector<EvaluationResult>& runs, double level = 0.95);

/// What the noise of the true poses adds at most to figures of a result, by their keys.
///
/// Of ATE, ARE, RPE, t_rel and r_rel; none if the result or the noise has no outcome. See
/// estimate_truth_noise().
[[nodiscard]] std::map<std::string, double> noise_floors(const EvaluationResult& result,
                                                         const TruthNoise& noise);

/// The comparison of one figure of two estimates.
struct FigureComparison {
  std::string key;        ///< as Metric
  Comparison comparison;  ///< of the second against the first
};

/// Compares two estimates of one drive by the errors over the same segments and steps.
///
/// No difference counts that is smaller than what `noise`, that of the true poses, adds to a figure
/// (noise_floors).
[[nodiscard]] std::vector<FigureComparison> compare_estimates(const EvaluationResult& first,
                                                              const EvaluationResult& second,
                                                              const TruthNoise& noise,
                                                              double level = 0.95);

/// Compares each further estimate with the first.
///
/// The noise is that of the true poses of the first's frames. Estimates should be of the same
/// frames, see on_common_frames(). Throws ArgumentError without any.
[[nodiscard]] std::vector<std::vector<FigureComparison>> compare_with_first(
    const std::vector<EvaluationResult>& results, double level = 0.95);

/// Writes the intervals for people, a line each.
std::string to_text(const std::vector<FigureInterval>& intervals);
/// Writes the sentences of the comparisons, a line each.
std::string to_text(const std::vector<FigureComparison>& comparisons);
/// Writes the intervals as a JSON object by the keys of the figures, without a newline.
std::string to_json(const std::vector<FigureInterval>& intervals);
/// Writes the comparisons as a JSON object by the keys of the figures, without a newline.
std::string to_json(const std::vector<FigureComparison>& comparisons);

}  // namespace placegraph
