#pragma once
#include <placegraph/eval/errors/delta.h>
#include <placegraph/eval/association/frame_pair.h>
#include <placegraph/eval/errors/statistics.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>

#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Relative errors besides those of consecutive frames.
struct RelativeErrorOptions {
  std::vector<Delta> deltas;                        ///< lengths of the steps, each judged by itself
  StepPairs pairs = StepPairs::kConsecutive;        ///< where the steps begin
};
void visit(OptionVisitor& field, RelativeErrorOptions& options);

/// The relative error of one step: E = (T_i^-1 T_j)_truth^-1 (T_i^-1 T_j)_estimate.
struct RelativeError {
  int first = 0, last = 0;   ///< i and j, positions in the list of pairs
  double translation_m = 0;  ///< |trans E|
  double rotation_deg = 0;   ///< angle of E
  double heading_deg = 0;      ///< angle of the part of E about the vertical; 0 without one
  double inclination_deg = 0;  ///< angle between the two up directions; 0 without a vertical
  double full = 0;           ///< Frobenius norm of E - I: metres and radians in one number
  double length_m = 0;       ///< difference of the lengths of both translations, not negative
};

/// Relative errors over all steps of one length.
struct RelativeErrors {
  Outcome outcome;                           ///< kTooFewData if there is no step
  Delta delta;                               ///< length of the steps
  StepPairs pairs = StepPairs::kConsecutive; ///< where they begin
  Statistics translation_m, rotation_deg;    ///< meaningful only if outcome
  bool has_vertical = false;                 ///< heading and inclination are judged
  Statistics heading_deg, inclination_deg;   ///< meaningful only if outcome and has_vertical
  Statistics full, length_m;                 ///< likewise
  std::vector<RelativeError> errors;         ///< by first pose
  int gaps = 0;                              ///< gaps within the drive, which no step crosses
};

/// Computes the relative errors over steps of one length (Sturm et al. 2012, V.A).
///
/// A step ends at the first pose at or beyond the delta, along the true path; for seconds, at the
/// pose nearest in time. No step has a gap within: a frame without estimate, or a hole in the times
/// (see gaps_before). Positions of the estimate are multiplied by `scale`. The angle is taken from
/// the skew part as well as the trace: acos of the trace alone cannot distinguish 0.02 deg from
/// zero in matrices of seven digits. With `up`, the vertical in the truth's world, the rotation of E
/// at the end of a step is divided into one about the vertical (heading) and one about a level axis
/// (inclination), as in Zhang and Scaramuzza 2018. Outcome: kTooFewData if no step fits,
/// kInconsistent for seconds without times.
[[nodiscard]] RelativeErrors relative_errors(const std::vector<FramePair>& pairs, bool has_times,
                                             const Delta& delta,
                                             StepPairs choice = StepPairs::kConsecutive,
                                             double scale = 1,
                                             const std::optional<Eigen::Vector3d>& up = {});

/// For every pair, whether a gap lies between it and the one before; true for the first.
///
/// A gap is a frame without estimate at either end, or a spacing of stamps (of frame numbers without
/// times) that is longer than the median one by half of it and by ten median deviations.
std::vector<bool> gaps_before(const std::vector<FramePair>& pairs);

}  // namespace placegraph
