#pragma once
#include <placegraph/eval/drawing/figure.h>
#include <placegraph/eval/trajectory/result.h>
#include <placegraph/graph/image/ground_picture.h>

#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

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

/// Their names, in the order of EvaluationPlot.
/// They are overview, xyz, rpy, rpe, lengths, box, violin.
const std::vector<std::string>& evaluation_plot_names();

/// Whether the results belong to one ground truth, or each to its own sequence.
enum class EvaluatedTruth {
  kShared,  ///< one ground truth
  kOwn      ///< each has a sequence of its own
};

/// A figure of the results that did not fail, of which the notes name the alignment.
/// Several sequences have a panel each in the overview. Throws ArgumentError for kXyz and kRpy of
/// several sequences, which have no time in common, and if there is nothing to draw. `ground`, in
/// the frame of the truth, stands under the view from above of the overview of one sequence;
/// ArgumentError for other figures, and if that view does not show x and y, or nothing of it.
Figure figure_of(const std::vector<EvaluationResult>& results, EvaluatedTruth truth,
                 EvaluationPlot kind, const std::optional<GroundPicture>& ground = {});

/// How the positions were aligned, in words.
std::string alignment_text(Alignment alignment);

}  // namespace placegraph
