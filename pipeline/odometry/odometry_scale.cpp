#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/odometry/odometry.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

void Odometry::set_motion(std::shared_ptr<const MeasuredMotion> motion_cam) {
  motion_ = scale_known_ ? nullptr : std::move(motion_cam);
  window_ = empty_window();
}

void Odometry::measure_scale(const Frame& frame, OdometryUpdate& update) {
  const auto span = times_.measure("scale");
  stamps_[last_keyframe_] = frame.stamp_ns;
  const bool height = !assumed_ || assumed_->ground_height;
  if (ground_ && height) measure_ground(frame, update);
  if (floor_ && height) measure_floor(update);
  if (motion_) measure_way(update);
}

/// All lengths of this run of tracking grow about the oldest keyframe of the window.
void Odometry::set_scale(double factor, OdometryUpdate& update) {
  const Eigen::Vector3d centre = window_.pose(window_.keyframes().front()).translation();
  window_.rescale(factor);
  for (auto& [id, T_odom_keyframe] : keyframe_poses_)
    T_odom_keyframe =
        SE3(T_odom_keyframe.rotation(), centre + factor * (T_odom_keyframe.translation() - centre));
  for (PointLandmark& landmark : past_landmarks_)
    if (landmark.keyframe >= first_keyframe_) landmark.point_cam *= factor;
  update.rescale = {factor, centre};
  median_depth_m_ *= factor;
  scale_known_ = true;
}

/// The length of the measured motion between two keyframes of the window, with its deviation.
std::optional<DistanceObservation> Odometry::measured_way(std::int64_t from,
                                                          std::int64_t to) const {
  const auto a = stamps_.find(from), b = stamps_.find(to);
  if (a == stamps_.end() || b == stamps_.end()) return std::nullopt;
  const auto motion = motion_->between(a->second, b->second);
  if (!motion) return std::nullopt;
  const Eigen::Vector3d t = motion->T_a_b.translation();
  const double length = t.norm();
  if (!(length > 0)) return std::nullopt;
  const Eigen::Vector3d along = motion->T_a_b.rotation().inverse() * t / length;
  const double sigma = std::sqrt(along.dot(motion->covariance.topLeftCorner<3, 3>() * along));
  if (sigma > 0.5 * length) return std::nullopt;  // hardly any way
  return DistanceObservation{from, to, length, sigma};
}

/// Measured motion gives the unit: at first by the median over the window, which a burst of slip
/// does not move; afterwards every keyframe's way from the last one is a distance of its own.
void Odometry::measure_way(OdometryUpdate& update) {
  constexpr std::size_t kWays = 5;
  const auto ids = window_.keyframes();
  if (scale_known_) {
    if (ids.size() < 2) return;
    if (const auto way = measured_way(ids[ids.size() - 2], ids.back())) window_.add_distance(*way);
    return;
  }
  std::vector<DistanceObservation> ways;
  std::vector<double> log_ratios;
  for (std::size_t i = 1; i < ids.size(); ++i) {
    const auto way = measured_way(ids[i - 1], ids[i]);
    const double seen =
        (window_.pose(ids[i]).translation() - window_.pose(ids[i - 1]).translation()).norm();
    if (!way || !(seen > 0)) continue;
    ways.push_back(*way);
    log_ratios.push_back(std::log(way->distance_m / seen));
  }
  if (ways.size() < kWays) return;
  set_scale(std::exp(median_of(log_ratios)), update);
  for (const DistanceObservation& way : ways) window_.add_distance(way);
}

void Odometry::measure_ground(const Frame& frame, OdometryUpdate& update) {
  const std::int64_t current = last_keyframe_;
  // The newest keyframe far enough away; any, while the unit is not the metre.
  std::int64_t old = -1;
  SE3 T_old_new;
  for (const auto& [id, keyframe] : keyframe_frames_) {
    const SE3 T = window_.pose(id).inverse() * window_.pose(current);
    const double length = T.translation().norm();
    if (length < (scale_known_ ? ground_->min_baseline_m() : 1e-6)) continue;
    old = id;
    T_old_new = T;
  }
  const Image image_old = old >= 0 ? keyframe_frames_.at(old).image : Image();
  keyframe_frames_[current] = frame;
  if (old < 0) return;
  const double length = T_old_new.translation().norm();
  if (scale_known_) {
    const auto measured = ground_->follow(frame.image, image_old, T_old_new, ground_sight(frame));
    if (!measured) return;
    const double distance_m = measured->factor * length;
    window_.add_distance({old, current, distance_m, measured->sigma_relative * distance_m});
    log(log_, LogLevel::kDebug, "ground {} {} length {:f} measured {:f} +- {:f}",
        keyframe_frames_.at(old).id, frame.id, length, distance_m,
        measured->sigma_relative * distance_m);
    return;
  }
  const auto measured = ground_->find(frame.image, image_old, T_old_new, ground_sight(frame));
  if (!measured) return;
  set_scale(measured->factor, update);
  const double distance_m = measured->factor * length;
  window_.add_distance({old, current, distance_m, measured->sigma_relative * distance_m});
}

}  // namespace placegraph
