#include <placegraph/pipeline/local_map/stereo_rectifier.h>

#include <cmath>

namespace placegraph {
namespace {

struct InverseDepthFromMotion {
  double value;  // [1/m]
  // Its inverse times the standard deviation of a ray [rad] is that of the value.
  double root_information;
};

/// The inverse depth of the newest observation along its ray, by least squares over the pixels of
/// the other keyframes.
std::optional<InverseDepthFromMotion> from_motion(
    const SlidingWindow& window, const Camera& camera,
    const std::vector<WindowObservation>& observations, const Eigen::Vector3d& ray) {
  const WindowObservation& newest = observations.back();
  const SE3 T_odom_newest = window.pose(newest.keyframe);
  // With X = ray + w t, each pixel m of another view gives X.x - m.x X.z = 0 and X.y - m.y X.z = 0.
  double cc = 0, cd = 0;
  for (const WindowObservation& other : observations) {
    const auto seen = camera.unproject(other.px);
    if (other.keyframe == newest.keyframe || !seen) continue;
    const SE3 T_other_newest = window.pose(other.keyframe).inverse() * T_odom_newest;
    const Eigen::Vector3d a = T_other_newest.rotation() * ray, &t = T_other_newest.translation();
    // Divided by the depth, these are errors on the image plane.
    const double depth = a.z() + *newest.inverse_depth * t.z();
    if (!(depth > 0.1)) continue;
    const Eigen::Vector2d c = (t.head<2>() - seen->head<2>() * t.z()) / depth;
    const Eigen::Vector2d d = (seen->head<2>() * a.z() - a.head<2>()) / depth;
    cc += c.squaredNorm();
    cd += c.dot(d);
  }
  if (!(cc > 0) || !(cd > 0)) return std::nullopt;
  return InverseDepthFromMotion{cd / cc, std::sqrt(cc)};
}

}  // namespace

StereoRectifier::StereoRectifier(const RectificationOptions& options,
                                 const Calibration& calibration, double sigma_track_px,
                                 double sigma_disparity_px)
    : camera_(calibration.camera),
      baseline_m_(calibration.baseline_m),
      sigma_track_px_(sigma_track_px),
      sigma_disparity_px_(sigma_disparity_px),
      estimator_(options) {}

/// Nothing if the motion predicts the disparity less accurately than to twice its own noise.
std::optional<DisparitySample> StereoRectifier::sample(const SlidingWindow& window,
                                                       LandmarkId landmark) const {
  const auto& observations = window.observations(landmark);
  const WindowObservation& newest = observations.back();
  const auto ray = camera_.unproject(newest.px);
  if (!newest.inverse_depth || !ray) return std::nullopt;
  const auto depth = from_motion(window, camera_, observations, *ray);
  if (!depth) return std::nullopt;
  const double px_per_inverse_depth = camera_.fx * baseline_m_;
  const double sigma_motion_px =
      sigma_track_px_ / camera_.fx / depth->root_information * px_per_inverse_depth;
  if (!(sigma_motion_px < 2 * sigma_disparity_px_)) return std::nullopt;
  const Eigen::Vector2d x = ray->head<2>();
  return DisparitySample{x, *newest.inverse_depth * px_per_inverse_depth + error().at(x),
                         depth->value * px_per_inverse_depth,
                         std::hypot(sigma_disparity_px_, sigma_motion_px)};
}

void StereoRectifier::calibrate(SlidingWindow& window, LineCue* lines) {
  // Views of a point with a known depth. Chosen.
  constexpr std::size_t kViews = 4;
  std::vector<DisparitySample> samples;
  std::set<LandmarkId> used;
  for (const LandmarkId id : window.landmarks()) {
    if (used_.count(id)) {
      used.insert(id);
    } else if (window.observations(id).size() >= kViews) {
      if (const auto of_landmark = sample(window, id)) {
        samples.push_back(*of_landmark);
        used.insert(id);
      }
    }
  }
  used_ = std::move(used);
  const RectificationError before = error();
  if (lines)
    for (const DisparitySample& of_line : lines->disparity_samples(window, before))
      samples.push_back(of_line);
  estimator_.add(samples);
  revise_disparities(window, before);
  if (lines) lines->revise_second_cameras(window, before, error());
}

void StereoRectifier::revise_disparities(SlidingWindow& window,
                                         const RectificationError& before) const {
  const RectificationError now = error();
  const double per_px = 1 / (camera_.fx * baseline_m_);
  for (const LandmarkId id : window.landmarks())
    for (const WindowObservation& o : window.observations(id)) {
      const auto ray = camera_.unproject(o.px);
      if (!o.inverse_depth || !ray) continue;
      const Eigen::Vector2d x = ray->head<2>();
      const double revised = *o.inverse_depth + (before.at(x) - now.at(x)) * per_px;
      window.revise_inverse_depth(o.keyframe, id, revised);
    }
}

}  // namespace placegraph
