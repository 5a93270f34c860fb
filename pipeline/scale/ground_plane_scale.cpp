#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/scale/ground_plane_scale.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace placegraph {
namespace {

/// Random walk of mean pitch and roll per measurement. Chosen.
constexpr double kMountingDrift_deg = 0.03;
// Standard deviation of the normal of a floor that is level according to edges, beyond that of the
// edges. Chosen.
constexpr double kLevelSigma_deg = 0.03;

}  // namespace

GroundPlaneScale::GroundPlaneScale(const GroundPlaneScaleOptions& options, const Camera& camera,
                                   double camera_height_m)
    : options_(options),
      camera_(camera),
      camera_height_m_(camera_height_m),
      normal_variance_rad2_(std::pow(deg_to_rad(options.mounting_sigma_deg), 2)) {
  options_.check();
  require(camera_height_m > 0, "camera_height_m: must be positive");
}

std::vector<Eigen::Vector2d> GroundPlaneScale::outline_px() const {
  const GroundPlaneOptions& o = options_.plane;
  std::vector<Eigen::Vector2d> outline;
  for (const auto& [x, z] : {std::pair(-o.half_width_heights, o.near_heights),
                             std::pair(-o.half_width_heights, o.far_heights),
                             std::pair(o.half_width_heights, o.far_heights),
                             std::pair(o.half_width_heights, o.near_heights)}) {
    // The point (x, y, z) of the plane, in camera heights: n x = 1.
    const double y = (1 - normal_cam_.x() * x - normal_cam_.z() * z) / normal_cam_.y();
    if (const auto px = camera_.project({x, y, z})) outline.push_back(*px);
  }
  return outline;
}

/// Standard deviation of one view's normal relative to the camera's mounting.
double GroundPlaneScale::sigma_of_view_rad() const {
  const double frame = deg_to_rad(options_.pitching_sigma_deg);
  return std::sqrt(normal_variance_rad2_ + frame * frame);
}

bool GroundPlaneScale::may_be_ground(const Eigen::Vector3d& level) const {
  return std::atan2(level.cross(normal_cam_).norm(), level.dot(normal_cam_)) <
         3 * sigma_of_view_rad();
}

GroundPlanePrior GroundPlaneScale::prior(const GroundMask& observation) const {
  if (observation.level)
    return {{*observation.level, camera_height_m_},
            std::hypot(deg_to_rad(kLevelSigma_deg), observation.level_sigma_rad)};
  return {plane_cam(), sigma_of_view_rad()};
}

/// The normal of a view is the mean plus the vehicle's pitching; the alignment reports its
/// posterior under prior() or a more certain prior, from which the posterior of the mean follows.
void GroundPlaneScale::learn(const GroundPlaneResult& found) {
  const double frame = deg_to_rad(options_.pitching_sigma_deg);
  const double before = normal_variance_rad2_ + frame * frame;
  const double gain = normal_variance_rad2_ / before;
  const double after = found.sigma_normal_rad * found.sigma_normal_rad;
  normal_cam_ = (normal_cam_ + gain * (found.plane_ref.normal - normal_cam_)).normalized();
  const double drift = deg_to_rad(kMountingDrift_deg);
  normal_variance_rad2_ += drift * drift - gain * gain * std::max(0.0, before - after);
}

std::optional<GroundPlaneScale::ScaleMeasurement> GroundPlaneScale::accept(
    const GroundPlaneResult& found) {
  if (!found.outcome) return std::nullopt;
  const double log_factor = std::log(camera_height_m_ / found.plane_ref.distance_m);
  // A car's side or a kerb may be mistaken for the road for a short time only.
  constexpr std::size_t kMemory = 5;
  bool is_within_gate = true;
  if (recent_log_factors_.size() >= 3) {
    const double median = median_of({recent_log_factors_.begin(), recent_log_factors_.end()});
    is_within_gate = std::abs(log_factor - median) < options_.max_log_jump;
  }
  recent_log_factors_.push_back(log_factor);
  if (recent_log_factors_.size() > kMemory) recent_log_factors_.pop_front();
  if (!is_within_gate) return std::nullopt;
  learn(found);
  return ScaleMeasurement{std::exp(log_factor),
                          std::hypot(found.sigma_log_distance, options_.sigma_relative)};
}

/// The front view is the reference. What is known of the ground is known of the new image.
GroundPlaneScale::Views GroundPlaneScale::views(const Image& image_new, const Image& image_old,
                                                const SE3& T_old_new,
                                                const GroundMask& observation) const {
  const bool backwards = T_old_new.translation().z() < 0;
  if (backwards && observation.mask.empty() && !observation.level)
    return {image_old, image_new, T_old_new.inverse()};
  return {image_new, image_old, T_old_new};
}

std::optional<GroundPlaneScale::ScaleMeasurement> GroundPlaneScale::find(
    const Image& image_new, const Image& image_old, const SE3& T_old_new,
    const GroundMask& observation) {
  recent_log_factors_.clear();
  const Views v = views(image_new, image_old, T_old_new, observation);
  GroundPlaneResult found = search_ground_plane(v.ref, v.cur, camera_, v.T_cur_ref,
                                                observation.level.value_or(normal_cam_),
                                                options_.plane, observation.mask);
  if (found.outcome && observation.level) {
    GroundPlanePrior level = prior(observation);
    level.plane_ref.distance_m = found.plane_ref.distance_m;
    found = align_ground_plane(v.ref, v.cur, camera_, v.T_cur_ref, level, options_.plane,
                               observation.mask);
  }
  const auto length = accept(found);
  recent_log_factors_.clear();  // it refers to another scale
  return length;
}

std::optional<GroundPlaneScale::ScaleMeasurement> GroundPlaneScale::follow(
    const Image& image_new, const Image& image_old, const SE3& T_old_new,
    const GroundMask& observation) {
  const Views v = views(image_new, image_old, T_old_new, observation);
  return accept(align_ground_plane(v.ref, v.cur, camera_, v.T_cur_ref, prior(observation),
                                   options_.plane, observation.mask));
}

}  // namespace placegraph
