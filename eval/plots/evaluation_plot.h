#pragma once
#include <placegraph/eval/plots/plot.h>
#include <placegraph/eval/trajectory/result.h>

#include <string>
#include <vector>

namespace placegraph {

/// What an evaluation is drawn as.
enum class EvaluationPlot {
  kOverview,  ///< trajectories from above and from the side, errors over distance and time
  kXyz,       ///< the three coordinates over time
  kRpy,       ///< roll, pitch and yaw over time
  kRpe,       ///< errors of the motion between consecutive frames over the distance
  kLengths,   ///< t_rel and r_rel over the lengths of segments
  kBox,       ///< medians, quartiles and extremes of the position errors
  kViolin     ///< densities of the position errors
};

/// Their names, in the order of EvaluationPlot: overview, xyz, rpy, rpe, lengths, box, violin.
const std::vector<std::string>& evaluation_plot_names();

/// Whether the results belong to one ground truth, or each to its own sequence.
enum class EvaluatedTruth { kShared, kOwn };

/// Ground truth, aligned estimates and their errors; failed results are left out. The curve of a
/// single estimate is coloured by its error.
Plot plot_of(const std::vector<EvaluationResult>& results);

/// A figure of the results that did not fail, of which the notes name the alignment. Several
/// sequences have a panel each in the overview. Throws ArgumentError for kXyz and kRpy of several
/// sequences, which have no time in common, and if there is nothing to draw.
Figure figure_of(const std::vector<EvaluationResult>& results, EvaluatedTruth truth,
                 EvaluationPlot kind);

/// How the positions were aligned, in words.
std::string alignment_text(Alignment alignment);

}  // namespace placegraph
