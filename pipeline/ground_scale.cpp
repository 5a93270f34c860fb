#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/ground_scale.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

void GroundScaleOptions::check() const {
  check_ranges(*this);
  plane.check();
}

void visit(OptionVisitor& field, GroundScaleOptions& o) {
  field.group("plane", o.plane, "direct alignment of the road");
  field("enabled", o.enabled, "use the ground plane where the camera height is known");
  field("sigma_relative", o.sigma_relative,
        "noise of a single scale beyond that of the alignment: the road is not flat", {0, 1});
  field("max_log_deviation", o.max_log_deviation,
        "a scale further from the present one (in logarithm) is not believed", {0.01, 5});
  field("normal_gain", o.normal_gain, "share of a new normal that enters the mean", {0.001, 1});
}

GroundScale::GroundScale(const GroundScaleOptions& options, const Camera& camera,
                         double camera_height_m)
    : options_(options), camera_(camera), camera_height_m_(camera_height_m) {
  options_.check();
  require(camera_height_m > 0, "camera_height_m: must be positive");
}

void GroundScale::learn(const Eigen::Vector3d& normal_cam) {
  ++learned_;
  const double gain = std::max(options_.normal_gain, 1.0 / (1 + learned_));
  normal_cam_ = (normal_cam_ + gain * (normal_cam - normal_cam_)).normalized();
}

std::optional<GroundScale::Length> GroundScale::find(const Image& image_new, const Image& image_old,
                                                     const SE3& T_old_new) {
  const auto found =
      search_ground_plane(image_new, image_old, camera_, T_old_new, normal_cam_, options_.plane);
  if (!found.outcome) return std::nullopt;
  learn(found.plane_ref.normal);
  refused_ = 0;
  return Length{camera_height_m_ / found.plane_ref.distance_m,
                std::hypot(found.sigma_log_distance, options_.sigma_relative)};
}

std::optional<GroundScale::Length> GroundScale::follow(const Image& image_new,
                                                       const Image& image_old,
                                                       const SE3& T_old_new) {
  const auto found =
      align_ground_plane(image_new, image_old, camera_, T_old_new, plane_cam(), options_.plane);
  if (!found.outcome) return std::nullopt;
  const double log_factor = std::log(camera_height_m_ / found.plane_ref.distance_m);
  // Lost for long: the present scale itself may be what is wrong.
  constexpr int kPatience = 10;
  if (std::abs(log_factor) > options_.max_log_deviation)
    return ++refused_ > kPatience ? find(image_new, image_old, T_old_new) : std::nullopt;
  refused_ = 0;
  learn(found.plane_ref.normal);
  return Length{std::exp(log_factor),
                std::hypot(found.sigma_log_distance, options_.sigma_relative)};
}

}  // namespace placegraph
