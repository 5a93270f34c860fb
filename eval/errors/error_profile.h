#pragma once
#include <placegraph/eval/errors/ape.h>
#include <placegraph/eval/association/frame_pair.h>
#include <placegraph/eval/errors/relative_error.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Errors of the frames whose speed, turning rate or distance lies in one interval.
struct ErrorGroup {
  double from = 0, to = 0;  ///< from <= value < to [m/s], [deg/s] or [m]
  int frames = 0;           ///< number of frames, and of the steps that begin there
  double ate_rmse_m = 0;    ///< RMSE of their position errors
  double rpe_trans_m = 0;   ///< RMSE of the relative errors of the steps, in translation
  double rpe_rot_deg = 0;   ///< and in rotation
};

/// Frames in a row that are among the hundredth with the largest errors.
struct WorstStretch {
  int first_frame = 0, last_frame = 0;       ///< as FramePair::frame
  double first_s = 0, last_s = 0;            ///< time since the first frame; 0 without times
  double first_m = 0, last_m = 0;            ///< length of the true path up to them
  double largest = 0;                        ///< the largest error [m]
};

/// How the scale of the estimate changes along the true path.
struct ScaleDrift {
  Outcome outcome;               ///< kTooFewData if fewer than three stretches move
  double percent_per_100m = 0;   ///< slope of the logarithm of the scale over the distance
  double smallest = 1, largest = 1;  ///< scale of the stretches, estimate over truth
};

/// Where the errors of an evaluation lie.
struct ErrorProfile {
  std::vector<ErrorGroup> by_speed, by_turning, by_distance;  ///< intervals with frames, ascending
  std::vector<WorstStretch> worst;       ///< of the position errors, the largest first
  std::vector<WorstStretch> worst_steps; ///< of the relative errors in translation
  ScaleDrift scale;                      ///< of twenty stretches of the true path
};

/// Sorts the errors of aligned pairs by what the body did.
///
/// `ape` and `rpe` are of these pairs, `rpe` over consecutive frames. Speeds and turning rates are
/// the truth's from frame to frame; `frame_rate_hz` gives the time without times.
[[nodiscard]] ErrorProfile error_profile(const std::vector<FramePair>& aligned_pairs,
                                         const std::vector<double>& travelled_m,
                                         const ApeResult& ape, const RelativeErrors& rpe,
                                         bool has_times, double frame_rate_hz);

}  // namespace placegraph
