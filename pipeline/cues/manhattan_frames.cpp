#include <placegraph/frontend/vanishing/manhattan_frame.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/pipeline/cues/manhattan_frames.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Standard deviation of one frame's directions, beyond its lines' noise (docs/cues.md). Chosen.
constexpr double kDirectionFloor_deg = 0.1;
/// Standard deviation in a new keyframe, beyond the window's covariance (docs/cues.md). Chosen.
constexpr double kDirectionDrift_deg = 1;

/// Squared distance between two rotations in standard deviations.
double frame_chi2(const SO3& a, const SO3& b, const Eigen::Matrix3d& covariance) {
  const Eigen::Vector3d e = (a.inverse() * b).log();
  return e.dot(covariance.llt().solve(e));
}

/// Gate that chance exceeds with a probability of one in a hundred.
double frame_gate() {
  static const double value = chi_squared_quantile(0.99, 3);
  return value;
}

}  // namespace

Eigen::Matrix3d ManhattanFrames::honest(const Eigen::Matrix3d& covariance) const {
  const double floor_rad = kDirectionFloor_deg * kRadPerDeg;
  return covariance + floor_rad * floor_rad * Eigen::Matrix3d::Identity();
}

std::vector<ManhattanFrames::Expected> ManhattanFrames::expected(const SlidingWindow& window,
                                                                 KeyframeId keyframe) const {
  std::vector<std::pair<KeyframeId, ManhattanFrameId>> order;  // last observation and id
  for (const auto& [manhattan_frame, seen] : last_seen_)
    if (covariance_.contains(manhattan_frame)) order.emplace_back(seen, manhattan_frame);
  std::sort(order.rbegin(), order.rend());
  const SO3 R_cam_map = window.pose(keyframe).rotation().inverse();
  const double drift_rad = kDirectionDrift_deg * kRadPerDeg;
  std::vector<Expected> result;
  for (const auto& [seen, manhattan_frame] : order)
    result.push_back(
        {manhattan_frame, R_cam_map * *window.manhattan_frame(manhattan_frame),
         covariance_.at(manhattan_frame) + drift_rad * drift_rad * Eigen::Matrix3d::Identity()});
  return result;
}

void ManhattanFrames::see(const Candidate& observation, ManhattanFrameId manhattan_frame,
                          SlidingWindow& window) {
  add_manhattan_observation(
      window, {observation.keyframe, manhattan_frame, observation.R_cam_manhattan,
               Eigen::Matrix3d((options_.correlation * honest(observation.covariance)).inverse())});
  last_seen_[manhattan_frame] = observation.keyframe;
}

std::optional<ManhattanFrameId> ManhattanFrames::add(KeyframeId keyframe,
                                                     const SO3& R_cam_manhattan,
                                                     const Eigen::Matrix3d& covariance,
                                                     SlidingWindow& window) {
  std::optional<Expected> best;
  double least = frame_gate();
  for (const Expected& manhattan_frame : expected(window, keyframe)) {
    const double distance = frame_chi2(manhattan_frame.R_cam_frame,
                                       nearest_axes(R_cam_manhattan, manhattan_frame.R_cam_frame),
                                       manhattan_frame.covariance + honest(covariance));
    if (distance < least) best = manhattan_frame, least = distance;
  }
  if (!best) return begin_manhattan_frame({keyframe, R_cam_manhattan, covariance}, window);
  see({keyframe, nearest_axes(R_cam_manhattan, best->R_cam_frame), covariance},
      best->manhattan_frame, window);
  return best->manhattan_frame;
}

/// A candidate waits until enough others in the window agree with it.
std::optional<ManhattanFrameId> ManhattanFrames::begin_manhattan_frame(const Candidate& newest,
                                                                       SlidingWindow& window) {
  const KeyframeId oldest = window.keyframes().front();
  std::erase_if(candidates_, [&](const Candidate& c) { return c.keyframe < oldest; });
  const auto R_map = [&](const Candidate& c) {
    return window.pose(c.keyframe).rotation() * c.R_cam_manhattan;
  };
  // Uncertainty of the rotation between keyframes of one window.
  constexpr double kMotionRad = 0.1 * kRadPerDeg;
  std::vector<Candidate> agreeing{newest}, others;
  for (Candidate other : candidates_) {
    const SO3 R_map_cam = window.pose(other.keyframe).rotation();
    other.R_cam_manhattan =
        R_map_cam.inverse() * nearest_axes(R_map_cam * other.R_cam_manhattan, R_map(newest));
    const bool agrees =
        other.keyframe != newest.keyframe &&
        frame_chi2(R_map(other), R_map(newest),
                   honest(other.covariance) + honest(newest.covariance) +
                       2 * kMotionRad * kMotionRad * Eigen::Matrix3d::Identity()) < frame_gate();
    (agrees ? agreeing : others).push_back(other);
  }
  if (static_cast<int>(agreeing.size()) < options_.persistence) {
    candidates_.push_back(newest);
    return std::nullopt;
  }
  candidates_ = std::move(others);
  forget_one(window);
  if (!window.manhattan_frame(kMapAxes)) {
    // Chosen: far below any measurement of a direction, so that the axes are held.
    constexpr double kExactRad = 1e-4;
    window.add_manhattan_frame(kMapAxes, SO3());
    add_manhattan_observation(window, {oldest, kMapAxes, window.pose(oldest).rotation().inverse(),
                                       Eigen::Matrix3d::Identity() / (kExactRad * kExactRad)});
    window.keep(manhattan_variable(kMapAxes));
    window.hold_manhattan_frame(kMapAxes);
  }
  const ManhattanFrameId manhattan_frame = next_id_++;
  window.add_manhattan_frame(manhattan_frame, R_map(newest));
  window.keep(manhattan_variable(manhattan_frame));
  for (const Candidate& observation : agreeing) see(observation, manhattan_frame, window);
  last_seen_[manhattan_frame] = newest.keyframe;
  return manhattan_frame;
}

void ManhattanFrames::forget_one(SlidingWindow& window) {
  if (static_cast<int>(last_seen_.size()) < options_.max_count) return;
  const auto longest =
      std::min_element(last_seen_.begin(), last_seen_.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  window.keep(manhattan_variable(longest->first), false);
  covariance_.erase(longest->first);
  last_seen_.erase(longest);
}

void ManhattanFrames::settle(const SlidingWindow& window) {
  covariance_.clear();
  for (const auto& [manhattan_frame, seen] : last_seen_)
    if (const auto covariance =
            manhattan_covariance(window, manhattan_frame, window.keyframes().back()))
      covariance_[manhattan_frame] = *covariance;
}

void ManhattanFrames::reset() {
  candidates_.clear();
  last_seen_.clear();
  covariance_.clear();
  next_id_ = ++ManhattanFrameId(kMapAxes);
}

}  // namespace placegraph
