#pragma once
#include <placegraph/eval/errors/ape.h>
#include <placegraph/eval/association/frame_pair.h>
#include <placegraph/eval/errors/relative_error.h>

#include <string>
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

/// A bound of the absolute errors: metres of the position, or degrees of the rotation.
struct ErrorBound {
  double value = 0.1;        ///< positive [m] or [deg]
  bool of_rotation = false;  ///< the bound is one of the rotation

  bool operator==(const ErrorBound&) const = default;
};

/// Reads bounds joined by commas, as "0.1m,1deg"; empty: none.
///
/// Throws ArgumentError if one has no such unit or is not positive.
std::vector<ErrorBound> parse_error_bounds(const std::string& text);
/// The bound as parse_error_bounds() reads it.
std::string to_string(const ErrorBound& bound);
/// Bounds joined by commas, as parse_error_bounds() reads them.
std::string to_string(const std::vector<ErrorBound>& bounds);

/// How much of the drive has errors below a bound.
///
/// A frame without an estimate is not below any bound, so that who loses the difficult part of a
/// drive has no larger share.
struct ShareBelow {
  Outcome outcome;    ///< no success if errors of that kind are not judged
  ErrorBound bound;   ///< the bound
  double frames = 0;  ///< share of the judged frames
  double path = 0;    ///< share of the true path: its steps of which both ends are below
};

/// The shares of the judged frames and of the true path with errors below each bound.
[[nodiscard]] std::vector<ShareBelow> shares_below(const std::vector<FramePair>& aligned_pairs,
                                                   const std::vector<double>& travelled_m,
                                                   const ApeResult& ape,
                                                   const std::vector<ErrorBound>& bounds);

}  // namespace placegraph
