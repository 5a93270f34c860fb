#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/eval/errors/error_profile.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace placegraph {
namespace {

/// What is known of one posed frame.
struct FrameErrors {
  double speed_m_per_s = 0, turning_deg_per_s = 0, distance_m = 0;
  double position_m = 0, translation_m = 0, rotation_deg = 0;
  bool moves = false;  ///< a step begins here
};

/// 1, 2 or 5 times a power of ten: the smallest that covers `range` in at most `most` intervals.
double interval_for(double range, double most) {
  if (!(range > 0)) return 1;
  const double power = std::pow(10, std::floor(std::log10(range / most)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power * most >= range) return factor * power;
  return 10 * power;
}

/// Errors by intervals of a value; `steps_only` leaves out frames where no step begins.
std::vector<ErrorGroup> grouped_by(const std::vector<FrameErrors>& frames,
                                   double FrameErrors::* value, bool steps_only) {
  constexpr double kIntervals = 10;  // chosen
  std::vector<double> sorted;
  for (const FrameErrors& frame : frames)
    if (frame.moves || !steps_only) sorted.push_back(frame.*value);
  if (sorted.empty()) return {};
  std::sort(sorted.begin(), sorted.end());
  // A jump of the truth does not widen the intervals of all others.
  const double width = interval_for(quantile(sorted, 0.99), kIntervals);
  std::map<long, ErrorGroup> groups;
  std::map<long, int> steps;
  for (const FrameErrors& frame : frames) {
    if (steps_only && !frame.moves) continue;
    // Rounding does not divide equal values at a bound.
    const long key = std::lround(std::floor(frame.*value / width + 1e-9));
    ErrorGroup& group = groups[key];
    ++group.frames;
    group.ate_rmse_m += frame.position_m * frame.position_m;
    if (!frame.moves) continue;
    ++steps[key];
    group.rpe_trans_m += frame.translation_m * frame.translation_m;
    group.rpe_rot_deg += frame.rotation_deg * frame.rotation_deg;
  }
  std::vector<ErrorGroup> rows;
  for (auto& [key, group] : groups) {
    const double n = std::max(1, steps[key]);
    group.from = static_cast<double>(key) * width;
    group.to = static_cast<double>(key + 1) * width;
    group.ate_rmse_m = std::sqrt(group.ate_rmse_m / group.frames);
    group.rpe_trans_m = std::sqrt(group.rpe_trans_m / n);
    group.rpe_rot_deg = std::sqrt(group.rpe_rot_deg / n);
    rows.push_back(group);
  }
  return rows;
}

/// An error at a pair of the list.
struct PlacedError {
  std::size_t pair;
  double error;
};

std::vector<WorstStretch> worst_of(const std::vector<PlacedError>& errors,
                                   const std::vector<FramePair>& pairs,
                                   const std::vector<double>& travelled_m, bool has_times) {
  if (errors.empty()) return {};
  // Between two of them as many as a second of video may lie. Chosen.
  constexpr std::size_t kApart = 10;
  std::vector<double> sorted;
  for (const PlacedError& each : errors) sorted.push_back(each.error);
  std::sort(sorted.begin(), sorted.end());
  const double least = quantile(sorted, 0.99);
  std::vector<WorstStretch> stretches;
  std::size_t last = 0;
  for (const auto& [i, error] : errors) {
    if (error < least) continue;
    const double seconds =
        has_times ? static_cast<double>(pairs[i].stamp_ns - pairs.front().stamp_ns) * 1e-9 : 0;
    if (stretches.empty() || i - last > kApart)
      stretches.push_back({pairs[i].frame, 0, seconds, 0, travelled_m[i], 0, 0});
    WorstStretch& stretch = stretches.back();
    stretch.last_frame = pairs[i].frame;
    stretch.last_s = seconds;
    stretch.last_m = travelled_m[i];
    stretch.largest = std::max(stretch.largest, error);
    last = i;
  }
  std::stable_sort(stretches.begin(), stretches.end(),
                   [](const auto& a, const auto& b) { return a.largest > b.largest; });
  return stretches;
}

/// Spreads of true and estimated positions over stretches of equal length, and their scales.
ScaleDrift scale_drift(const std::vector<FramePair>& pairs,
                       const std::vector<double>& travelled_m) {
  constexpr int kStretches = 20;  // chosen
  ScaleDrift drift;
  struct Scale {
    double distance_m, log_scale;
  };
  std::vector<Scale> scales;
  std::size_t i = 0;
  for (int k = 0; k < kStretches; ++k) {
    const double end_m = travelled_m.back() * (k + 1) / kStretches;
    std::vector<const FramePair*> members;
    for (; i < pairs.size() && (travelled_m[i] <= end_m || k + 1 == kStretches); ++i)
      if (pairs[i].T_world_estimate) members.push_back(&pairs[i]);
    if (members.size() < 3) continue;
    Eigen::Vector3d truth = Eigen::Vector3d::Zero(), estimate = Eigen::Vector3d::Zero();
    for (const FramePair* pair : members) {
      truth += pair->T_world_truth.translation();
      estimate += pair->T_world_estimate->translation();
    }
    truth /= static_cast<double>(members.size());
    estimate /= static_cast<double>(members.size());
    double truth_m2 = 0, estimate_m2 = 0;
    for (const FramePair* pair : members) {
      truth_m2 += (pair->T_world_truth.translation() - truth).squaredNorm();
      estimate_m2 += (pair->T_world_estimate->translation() - estimate).squaredNorm();
    }
    if (truth_m2 > 0 && estimate_m2 > 0)
      scales.push_back({end_m * (k + 0.5) / (k + 1), 0.5 * std::log(estimate_m2 / truth_m2)});
  }
  if (scales.size() < 3) {
    drift.outcome = Outcome::failure(Outcome::Code::kTooFewData,
                                     "fewer than three stretches of the path show a scale");
    return drift;
  }
  double x = 0, y = 0, xx = 0, xy = 0, low = scales.front().log_scale, high = low;
  for (const Scale& s : scales) {
    x += s.distance_m / static_cast<double>(scales.size());
    y += s.log_scale / static_cast<double>(scales.size());
    low = std::min(low, s.log_scale);
    high = std::max(high, s.log_scale);
  }
  for (const Scale& s : scales) {
    xx += (s.distance_m - x) * (s.distance_m - x);
    xy += (s.distance_m - x) * (s.log_scale - y);
  }
  drift.percent_per_100m = 100 * 100 * xy / xx;
  drift.smallest = std::exp(low);
  drift.largest = std::exp(high);
  drift.outcome = Outcome::ok();
  return drift;
}

}  // namespace

ErrorProfile error_profile(const std::vector<FramePair>& aligned_pairs,
                           const std::vector<double>& travelled_m, const ApeResult& ape,
                           const RelativeErrors& rpe, bool has_times, double frame_rate_hz) {
  ErrorProfile profile;
  std::vector<FrameErrors> frames;
  std::vector<PlacedError> positions, steps;
  frames.reserve(aligned_pairs.size());
  positions.reserve(ape.frames.size());
  steps.reserve(rpe.errors.size());
  auto step = rpe.errors.begin();
  for (std::size_t i = 0, posed = 0; i < aligned_pairs.size(); ++i) {
    const FramePair& pair = aligned_pairs[i];
    if (!pair.T_world_estimate) continue;
    FrameErrors frame;
    frame.distance_m = travelled_m[i];
    frame.position_m = ape.frame_errors_m[posed++];
    positions.push_back({i, frame.position_m});
    while (step != rpe.errors.end() && step->first < static_cast<int>(i)) ++step;
    if (step != rpe.errors.end() && step->first == static_cast<int>(i)) {
      const FramePair& next = aligned_pairs[static_cast<std::size_t>(step->last)];
      const double seconds = has_times ? static_cast<double>(next.stamp_ns - pair.stamp_ns) * 1e-9
                                       : (next.frame - pair.frame) / frame_rate_hz;
      const Eigen::Matrix4d motion = relative_pose(pair.T_world_truth, next.T_world_truth);
      frame.speed_m_per_s = motion.topRightCorner<3, 1>().norm() / seconds;
      frame.turning_deg_per_s =
          rad_to_deg(rotation_angle(motion.topLeftCorner<3, 3>())) / seconds;
      frame.translation_m = step->translation_m;
      frame.rotation_deg = step->rotation_deg;
      frame.moves = true;
      steps.push_back({i, step->translation_m});
    }
    frames.push_back(frame);
  }
  profile.by_speed = grouped_by(frames, &FrameErrors::speed_m_per_s, true);
  profile.by_turning = grouped_by(frames, &FrameErrors::turning_deg_per_s, true);
  profile.by_distance = grouped_by(frames, &FrameErrors::distance_m, false);
  profile.worst = worst_of(positions, aligned_pairs, travelled_m, has_times);
  profile.worst_steps = worst_of(steps, aligned_pairs, travelled_m, has_times);
  profile.scale = scale_drift(aligned_pairs, travelled_m);
  return profile;
}

std::vector<ErrorBound> parse_error_bounds(const std::string& text) {
  std::vector<ErrorBound> bounds;
  for (const Delta& length : parse_deltas(text)) {
    const bool of_rotation = length.unit == Delta::Unit::kDegrees;
    require(of_rotation || length.unit == Delta::Unit::kMetres,
            "'" + text + "' is no bound of errors (0.1m: position, 1deg or 0.02rad: rotation)");
    bounds.push_back({length.value, of_rotation});
  }
  return bounds;
}

std::string to_string(const ErrorBound& bound) {
  return fmt::format("{}{}", bound.value, bound.of_rotation ? "deg" : "m");
}

std::string to_string(const std::vector<ErrorBound>& bounds) {
  std::vector<std::string> texts;
  for (const ErrorBound& bound : bounds) texts.push_back(to_string(bound));
  return fmt::format("{}", fmt::join(texts, ","));
}

std::vector<ShareBelow> shares_below(const std::vector<FramePair>& aligned_pairs,
                                     const std::vector<double>& travelled_m, const ApeResult& ape,
                                     const std::vector<ErrorBound>& bounds) {
  std::vector<ShareBelow> shares;
  for (const ErrorBound& bound : bounds) {
    ShareBelow share;
    share.bound = bound;
    share.outcome = bound.of_rotation ? ape.rotation_outcome : ape.outcome;
    shares.push_back(share);
    if (!share.outcome) continue;
    const std::vector<double>& errors =
        bound.of_rotation ? ape.frame_errors_deg : ape.frame_errors_m;
    bool before = false;
    double frames = 0, path_m = 0;
    for (std::size_t i = 0, posed = 0; i < aligned_pairs.size(); ++i) {
      const bool below =
          aligned_pairs[i].T_world_estimate.has_value() && errors[posed++] < bound.value;
      frames += below;
      if (below && before) path_m += travelled_m[i] - travelled_m[i - 1];
      before = below;
    }
    shares.back().frames = frames / static_cast<double>(aligned_pairs.size());
    if (travelled_m.back() > 0) shares.back().path = path_m / travelled_m.back();
  }
  return shares;
}

}  // namespace placegraph
