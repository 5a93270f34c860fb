#include <placegraph/graph/core/median.h>
#include <placegraph/graph/text/log_message.h>
#include <placegraph/pipeline/local_map/metric_scale.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

void MetricScale::use_ground_plane(const GroundPlaneScaleOptions& options, const Camera& camera,
                                   double height_m) {
  ground_.emplace(options, camera, height_m);
}

void MetricScale::use_floor_lines(const FloorLineScaleOptions& options, const Camera& camera,
                                  double height_m) {
  floor_.emplace(options, camera, height_m);
}

void MetricScale::use_motion(std::shared_ptr<const MeasuredMotion> motion_cam) {
  motion_ = std::move(motion_cam);
}

void MetricScale::reset() {
  stamps_ns_.clear();
  frames_.clear();
  compared_.reset();
  if (floor_) floor_->reset();
}

void MetricScale::remember(KeyframeId keyframe, const Frame& frame) {
  stamps_ns_[keyframe] = frame.stamp_ns;
  if (ground_) frames_[keyframe] = frame;
}

std::optional<Rescale> MetricScale::measure(const KeyframeImages& images, const Cues& cues,
                                            LocalMap& map) {
  stamps_ns_[map.newest()] = images.frame.stamp_ns;
  std::erase_if(frames_, [&](const auto& f) { return f.first < map.window_begin(); });
  std::optional<Rescale> rescale;
  if (ground_ && height_trusted_) rescale = measure_ground(images, cues, map);
  if (floor_ && height_trusted_) rescale = measure_floor(cues, map);
  if (motion_)
    if (const auto by_motion = measure_motion(map)) rescale = by_motion;
  return rescale;
}

std::vector<Eigen::Vector2d> MetricScale::ground_outline_px() const {
  return ground_ ? ground_->outline_px() : std::vector<Eigen::Vector2d>();
}

/// Ground mask from surface labels, the edges of the newest keyframe and the mask of its frame.
GroundMask MetricScale::ground_in(const KeyframeImages& images, const Cues& cues) const {
  GroundMask ground;
  if (cues.manhattan) ground = cues.manhattan->ground(ground_->outline_px());
  if (ground.level && !ground_->may_be_ground(*ground.level)) ground = {};
  for (const Image& mask : {images.ground(), images.given_mask}) {
    if (ground.mask.empty())
      ground.mask = mask;
    else if (!mask.empty())
      ground.mask = ground.mask & mask;
  }
  return ground;
}

std::optional<Rescale> MetricScale::measure_ground(const KeyframeImages& images, const Cues& cues,
                                                   LocalMap& map) {
  constexpr double kAnyBaseline = 1e-6;  // while the scale is arbitrary
  SlidingWindow& window = map.window();
  const KeyframeId current = map.newest();
  const bool known = map.metric();
  // The newest keyframe that is far enough away.
  std::optional<KeyframeId> old;
  SE3 T_old_new;
  for (const auto& [id, frame] : frames_) {
    const SE3 T = window.pose(id).inverse() * window.pose(current);
    if (T.translation().norm() < (known ? ground_->min_baseline_m() : kAnyBaseline)) continue;
    old = id;
    T_old_new = T;
  }
  const Frame old_frame = old ? frames_.at(*old) : Frame();
  frames_[current] = images.frame;
  if (!old) return std::nullopt;
  const GroundMask ground = ground_in(images, cues);
  const auto measured =
      known ? ground_->follow(images.frame.image, old_frame.image, T_old_new, ground)
            : ground_->find(images.frame.image, old_frame.image, T_old_new, ground);
  if (!measured) return std::nullopt;
  const double length = T_old_new.translation().norm();
  const double distance_m = measured->factor * length;
  std::optional<Rescale> rescale;
  if (!known) rescale = map.rescale(measured->factor);
  add_distance(window, {*old, current, distance_m, measured->sigma_relative * distance_m});
  if (!known) return rescale;
  compared_ = {current, std::log(measured->factor)};
  log(log_, LogLevel::kDebug, "ground {} {} length {:f} measured {:f} +- {:f}", old_frame.id,
      images.frame.id, length, distance_m, measured->sigma_relative * distance_m);
  return std::nullopt;
}

std::optional<Rescale> MetricScale::measure_floor(const Cues& cues, LocalMap& map) {
  SlidingWindow& window = map.window();
  const KeyframeId current = map.newest();
  const bool known = map.metric();
  const auto measured = floor_->measure(window.pose(current), cues.lines->placed(window),
                                        cues.lines->shared_directions(), known);
  constexpr std::int64_t kLong = 30;  // keyframes
  if (!measured && !known && current.value() - map.first().value() == kLong)
    log(log_, LogLevel::kWarning,
        "no floor was found in {} keyframes: camera_height_m has not provided a scale yet, and "
        "poses are withheld",
        kLong);
  if (!measured) return std::nullopt;
  std::optional<Rescale> rescale;
  if (!known) rescale = map.rescale(measured->factor);
  // The newest keyframe that is far enough away; during initialization the first one.
  std::optional<KeyframeId> old;
  const Eigen::Vector3d here = window.pose(current).translation();
  for (const KeyframeId id : window.keyframes()) {
    const double length = (window.pose(id).translation() - here).norm();
    if (length >= floor_->min_baseline_m() || (!known && !old && length > 0)) old = id;
  }
  if (!old) return rescale;
  if (known) compared_ = {current, std::log(measured->factor)};
  const double distance_m =
      (known ? measured->factor : 1) * (window.pose(*old).translation() - here).norm();
  add_distance(window, {*old, current, distance_m, measured->sigma_relative * distance_m});
  log(log_, LogLevel::kDebug, "floor: factor {:f} +- {:f}", measured->factor,
      measured->sigma_relative);
  return rescale;
}

/// The length of the measured motion between two keyframes of the window, with its standard
/// deviation.
std::optional<DistanceObservation> MetricScale::measured_distance(KeyframeId from,
                                                                  KeyframeId to) const {
  // Standard deviation over length above which the motion is too uncertain.
  constexpr double kLeastKnown = 0.5;
  const auto a = stamps_ns_.find(from), b = stamps_ns_.find(to);
  if (a == stamps_ns_.end() || b == stamps_ns_.end()) return std::nullopt;
  const auto motion = motion_->between(a->second, b->second);
  if (!motion) return std::nullopt;
  const Eigen::Vector3d t = motion->T_a_b.translation();
  const double length = t.norm();
  if (!(length > 0)) return std::nullopt;
  const Eigen::Vector3d along = motion->T_a_b.rotation().inverse() * t / length;
  const double sigma = std::sqrt(along.dot(motion->covariance.topLeftCorner<3, 3>() * along));
  if (sigma > kLeastKnown * length) return std::nullopt;
  return DistanceObservation{from, to, length, sigma};
}

/// The first scale is the median over the window, which a burst of wheel slip does not affect;
/// afterwards each keyframe's motion from the last one is a distance constraint.
std::optional<Rescale> MetricScale::measure_motion(LocalMap& map) {
  // Distances for the median. Chosen.
  constexpr std::size_t kDistances = 5;
  SlidingWindow& window = map.window();
  const auto ids = window.keyframes();
  if (map.metric()) {
    if (ids.size() < 2) return std::nullopt;
    if (const auto distance = measured_distance(ids[ids.size() - 2], ids.back()))
      add_distance(window, *distance);
    return std::nullopt;
  }
  std::vector<DistanceObservation> distances;
  std::vector<double> log_ratios;
  for (std::size_t i = 1; i < ids.size(); ++i) {
    const auto distance = measured_distance(ids[i - 1], ids[i]);
    const double seen =
        (window.pose(ids[i]).translation() - window.pose(ids[i - 1]).translation()).norm();
    if (!distance || !(seen > 0)) continue;
    distances.push_back(*distance);
    log_ratios.push_back(std::log(distance->distance_m / seen));
  }
  if (distances.size() < kDistances) return std::nullopt;
  const Rescale rescale = map.rescale(std::exp(median_of(log_ratios)));
  for (const DistanceObservation& distance : distances) add_distance(window, distance);
  return rescale;
}

}  // namespace placegraph
