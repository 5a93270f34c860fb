#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/graph/geometry/bounded_covariance.h>
#include <placegraph/pipeline/local_map/local_map.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

LocalMap::LocalMap(const SlidingWindowOptions& options, const Camera& camera, Scale scale)
    : options_(options), camera_(camera), window_(options, camera), scale_(scale) {}

void LocalMap::restart(Scale scale, const std::optional<double>& median_depth) {
  past_landmarks_ = landmarks();
  for (const WindowObservation& observation : window_observations()) keep_observation(observation);
  observed_before_.clear();
  window_ = SlidingWindow(options_, camera_);
  uncertainty_.restart();
  scale_ = scale;
  median_depth_ = median_depth.value_or(median_depth_);
  first_ = next_;
  poses_.clear();
  links_.clear();
}

void LocalMap::go_on_from(KeyframeId next_keyframe, double median_depth) {
  next_ = next_keyframe;
  median_depth_ = median_depth;
}

KeyframeId LocalMap::add_keyframe(const SE3& T_odom_cam,
                                  const std::optional<std::int64_t>& stamp_ns) {
  window_.add_keyframe(
      next_, T_odom_cam,
      stamp_ns ? std::optional(1e-9 * static_cast<double>(*stamp_ns)) : std::nullopt);
  return next_++;
}

void LocalMap::discard(double median_depth) {
  past_observations_.erase(past_observations_.lower_bound(first_), past_observations_.end());
  observed_before_.clear();
  window_ = SlidingWindow(options_, camera_);
  poses_.clear();
  links_.clear();
  next_ = first_;
  median_depth_ = median_depth;
}

Outcome LocalMap::optimize() {
  return window_.keyframes().size() < 2 ? Outcome::ok() : window_.optimize().outcome;
}

void LocalMap::update_poses(const std::vector<double>& depths, bool rotations_corrected) {
  // Avoids a division by zero; no scene is so near. Chosen.
  constexpr double kLeastDepth = 1e-3;
  if (!depths.empty()) median_depth_ = std::max(kLeastDepth, median_of(depths));
  if (rotations_corrected) widen_link_to_oldest();
  for (const KeyframeId id : window_.keyframes()) poses_[id] = window_.pose(id);
}

void LocalMap::widen_link_to_oldest() {
  const KeyframeId oldest = window_.keyframes().front();
  const auto link = links_.find(KeyframeId(oldest.value() - 1));
  const auto before = poses_.find(oldest);
  if (link == links_.end() || before == poses_.end()) return;
  const Eigen::Vector3d rotated =
      (before->second.rotation().inverse() * window_.pose(oldest).rotation()).log();
  link->second.motion.by_observations.bottomRightCorner<3, 3>() += rotated * rotated.transpose();
}

void LocalMap::marginalize() {
  const auto keyframes = window_.keyframes();
  const auto size = static_cast<std::size_t>(options_.max_keyframes);
  if (keyframes.size() <= size) return;
  if (keyframes.front() > assessed_) {
    uncertainty_.add_window(window_);
    assessed_ = keyframes.back();
  }
  for (std::size_t i = 0; i + 1 < keyframes.size() && keyframes.size() - i > size; ++i)
    links_[keyframes[i]] = {motion(keyframes[i], keyframes[i + 1]), scale_drift()};
  std::map<LandmarkId, PointLandmark> before;  // those that are in the map if they leave
  for (const LandmarkId id : window_.landmarks()) {
    const std::vector<WindowObservation>& observations = window_.observations(id);
    if (observations.empty() || (observations.size() == 1 && !observed_before_.contains(id)))
      continue;
    before[id] = describe(id);
    // Those that the newest keyframe observes stay.
    if (observations.back().keyframe < keyframes.back())
      before[id].covariance = covariance_of(before[id]);
  }
  const std::vector<WindowObservation> observed = window_observations();
  window_.marginalize();
  const KeyframeId oldest = window_.keyframes().front();
  for (const WindowObservation& observation : observed) {
    const bool stays = window_.landmark(observation.landmark).has_value();
    if (stays && observation.keyframe >= oldest) continue;
    if (!stays && !before.contains(observation.landmark)) continue;
    keep_observation(observation);
    if (stays) observed_before_.insert(observation.landmark);
  }
  for (const auto& [id, landmark] : before) {
    if (window_.landmark(id)) continue;
    past_landmarks_.push_back(landmark);
    observed_before_.erase(id);
  }
}

std::vector<WindowObservation> LocalMap::window_observations() const {
  std::vector<WindowObservation> result;
  for (const LandmarkId id : window_.landmarks()) {
    const std::vector<WindowObservation>& observations = window_.observations(id);
    result.insert(result.end(), observations.begin(), observations.end());
  }
  return result;
}

void LocalMap::keep_observation(const WindowObservation& observation) {
  past_observations_[observation.keyframe].push_back(
      {observation.landmark, observation.px.cast<float>()});
}

Rescale LocalMap::rescale(double factor) {
  const Eigen::Vector3d centre = window_.pose(window_.keyframes().front()).translation();
  window_.rescale(factor);
  for (auto& [id, T_odom_keyframe] : poses_)
    T_odom_keyframe =
        SE3(T_odom_keyframe.rotation(), centre + factor * (T_odom_keyframe.translation() - centre));
  for (PointLandmark& landmark : past_landmarks_)
    if (landmark.keyframe >= first_) landmark.point_cam *= factor;
  for (auto& [id, link] : links_) link.motion = link.motion.scaled(factor);
  median_depth_ *= factor;
  scale_ = Scale::kMetric;
  return {factor, centre};
}

LocalMap::Link LocalMap::link(KeyframeId id) const {
  const auto link = links_.find(id);
  if (link != links_.end()) return link->second;
  return {motion(id, ++KeyframeId(id)), scale_drift()};
}

/// Drift of the scale (logarithm) from one keyframe to the next: half a window's worth, distributed
/// over its links. The landmarks observed in both halves constrain it.
double LocalMap::scale_drift() const {
  if (metric()) return 0;
  // Drift where it is not determined, and bound elsewhere: 10 % a keyframe. Chosen.
  constexpr double kMost = 0.1;
  const auto ids = window_.keyframes();
  if (ids.size() < 3) return kMost;
  const double sigma =
      sigma_log_length_ratio(window_, ids.front(), ids[ids.size() / 2], ids.back());
  return std::min(kMost, sigma / std::sqrt(0.5 * static_cast<double>(ids.size() - 1)));
}

AssessedMotion LocalMap::motion(KeyframeId from, KeyframeId to) const {
  const Matrix6d stated = bounded_covariance(stated_information(from, to));
  return assess_motion(window_, from, to, stated, metric());
}

Matrix6d LocalMap::information(const AssessedMotion& motion) const {
  return bounded_inverse(uncertainty_.covariance(motion), 0);
}

/// The information by the stated noise of the observations.
Matrix6d LocalMap::stated_information(KeyframeId from, KeyframeId to) const {
  Matrix6d information = relative_information(window_, from, to);
  if (metric()) return information;
  // The prior's constraint on the scale is arbitrary and common to all motions: no error of this
  // one.
  const SE3 T_from_to = window_.pose(from).inverse() * window_.pose(to);
  const double length = T_from_to.translation().norm();
  if (!(length > 0)) return information;
  const Eigen::Vector3d along = T_from_to.rotation().inverse() * T_from_to.translation() / length;
  const double sigma = std::max(1e-3, scale_drift()) * length;
  information.topLeftCorner<3, 3>() += along * along.transpose() / (sigma * sigma);
  return information;
}

std::optional<KeyframeId> LocalMap::window_begin() const {
  const auto ids = window_.keyframes();
  if (ids.empty()) return std::nullopt;
  return ids.front();
}

int LocalMap::landmarks_in_window() const {
  return static_cast<int>(window_.landmarks().size() + window_.lines().size());
}

PointLandmark LocalMap::describe(LandmarkId id) const {
  const auto& observations = window_.observations(id);
  PointLandmark landmark;
  landmark.id = id;
  landmark.keyframe = observations.front().keyframe;
  landmark.point_cam = window_.pose(landmark.keyframe).inverse() * *window_.landmark(id);
  landmark.observations = static_cast<int>(observations.size());
  return landmark;
}

std::optional<Eigen::Matrix3d> LocalMap::covariance_of(const PointLandmark& landmark) const {
  const auto covariance = landmark_covariance(window_, landmark.id);
  if (!covariance) return std::nullopt;
  const Eigen::Matrix3d R_keyframe_map =
      window_.pose(landmark.keyframe).rotation().matrix().transpose();
  return R_keyframe_map * *covariance * R_keyframe_map.transpose();
}

std::vector<PointLandmark> LocalMap::landmarks(std::size_t first) const {
  require(first <= past_landmarks_.size(),
          "LocalMap::landmarks: landmarks of the window have no order");
  std::vector<PointLandmark> result(past_landmarks_.begin() + static_cast<std::ptrdiff_t>(first),
                                    past_landmarks_.end());
  for (const LandmarkId id : window_.landmarks())
    if (!window_.observations(id).empty()) {
      result.push_back(describe(id));
      result.back().covariance = covariance_of(result.back());
    }
  return result;
}

std::vector<std::pair<KeyframeId, std::vector<LandmarkObservation>>> LocalMap::observations(
    KeyframeId from) const {
  std::map<KeyframeId, std::vector<LandmarkObservation>> all(past_observations_.lower_bound(from),
                                                             past_observations_.end());
  for (const WindowObservation& observation : window_observations())
    if (observation.keyframe >= from)
      all[observation.keyframe].push_back({observation.landmark, observation.px.cast<float>()});
  for (auto& [keyframe, observations] : all)
    std::ranges::sort(observations, {}, &LandmarkObservation::landmark);
  return {all.begin(), all.end()};
}

}  // namespace placegraph
