#include <placegraph/frontend/internal/vanishing/manhattan_frame.h>
#include <placegraph/graph/internal/core/angle.h>
#include <placegraph/graph/internal/core/chi_squared.h>
#include <placegraph/pipeline/internal/cues/manhattan_frames.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Squared distance in deviations between two rotations.
double frame_chi2(const SO3& a, const SO3& b, const Eigen::Matrix3d& covariance) {
  const Eigen::Vector3d e = (a.inverse() * b).log();
  return e.dot(covariance.llt().solve(e));
}

/// What a chance of one in a hundred reaches.
double frame_gate() {
  static const double value = chi_squared_quantile(0.99, 3);
  return value;
}

}  // namespace

Eigen::Matrix3d ManhattanWorlds::honest(const Eigen::Matrix3d& covariance) const {
  const double floor_rad = options_.sigma_floor_deg * kRadPerDeg;
  return covariance + floor_rad * floor_rad * Eigen::Matrix3d::Identity();
}

std::vector<ManhattanWorlds::Expected> ManhattanWorlds::expected(const SlidingWindow& window,
                                                                 KeyframeId keyframe) const {
  std::vector<std::pair<KeyframeId, ManhattanFrameId>> order;  // when, which
  for (const auto& [world, seen] : last_seen_)
    if (covariance_.contains(world)) order.emplace_back(seen, world);
  std::sort(order.rbegin(), order.rend());
  const SO3 R_cam_map = window.pose(keyframe).rotation().inverse();
  const double drift_rad = options_.sigma_drift_deg * kRadPerDeg;
  std::vector<Expected> result;
  for (const auto& [seen, world] : order)
    result.push_back({world, R_cam_map * *window.world(world),
                      covariance_.at(world) + drift_rad * drift_rad * Eigen::Matrix3d::Identity()});
  return result;
}

void ManhattanWorlds::see(const Candidate& sighting, ManhattanFrameId world,
                          SlidingWindow& window) {
  add_world_observation(
      window, {sighting.keyframe, world, sighting.R_cam_manhattan,
               Eigen::Matrix3d((options_.correlation * honest(sighting.covariance)).inverse())});
  last_seen_[world] = sighting.keyframe;
}

std::optional<ManhattanFrameId> ManhattanWorlds::add(KeyframeId keyframe,
                                                     const SO3& R_cam_manhattan,
                                                     const Eigen::Matrix3d& covariance,
                                                     SlidingWindow& window) {
  std::optional<Expected> best;
  double least = frame_gate();
  for (const Expected& world : expected(window, keyframe)) {
    const double distance =
        frame_chi2(world.R_cam_world, nearest_axes(R_cam_manhattan, world.R_cam_world),
                   world.covariance + honest(covariance));
    if (distance < least) best = world, least = distance;
  }
  if (!best) return begin_world({keyframe, R_cam_manhattan, covariance}, window);
  see({keyframe, nearest_axes(R_cam_manhattan, best->R_cam_world), covariance}, best->world,
      window);
  return best->world;
}

/// A candidate waits until enough of the window agree with it.
std::optional<ManhattanFrameId> ManhattanWorlds::begin_world(const Candidate& newest,
                                                             SlidingWindow& window) {
  const KeyframeId oldest = window.keyframes().front();
  std::erase_if(candidates_, [&](const Candidate& c) { return c.keyframe < oldest; });
  const auto R_map = [&](const Candidate& c) {
    return window.pose(c.keyframe).rotation() * c.R_cam_manhattan;
  };
  constexpr double kMotionRad = 0.1 * kRadPerDeg;  // between keyframes of one window
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
  if (!window.world(kMapAxes)) {
    constexpr double kExactRad = 1e-4;
    window.add_world(kMapAxes, SO3());
    add_world_observation(window, {oldest, kMapAxes, window.pose(oldest).rotation().inverse(),
                                   Eigen::Matrix3d::Identity() / (kExactRad * kExactRad)});
    window.keep(world_variable(kMapAxes));
    window.hold_world(kMapAxes);
  }
  const ManhattanFrameId world = next_world_++;
  window.add_world(world, R_map(newest));
  window.keep(world_variable(world));
  for (const Candidate& sighting : agreeing) see(sighting, world, window);
  last_seen_[world] = newest.keyframe;
  return world;
}

void ManhattanWorlds::forget_one(SlidingWindow& window) {
  if (static_cast<int>(last_seen_.size()) < options_.max_worlds) return;
  const auto longest =
      std::min_element(last_seen_.begin(), last_seen_.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  window.keep(world_variable(longest->first), false);
  covariance_.erase(longest->first);
  last_seen_.erase(longest);
}

void ManhattanWorlds::settle(const SlidingWindow& window) {
  covariance_.clear();
  for (const auto& [world, seen] : last_seen_)
    if (const auto covariance = world_covariance(window, world, window.keyframes().back()))
      covariance_[world] = *covariance;
}

void ManhattanWorlds::reset() {
  candidates_.clear();
  last_seen_.clear();
  covariance_.clear();
  next_world_ = ++ManhattanFrameId(kMapAxes);
}

}  // namespace placegraph
