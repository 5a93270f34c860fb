#include <placegraph/frontend/features/depth_lookup.h>
#include <placegraph/pipeline/cues/depth_sensor.h>

namespace placegraph {

std::vector<std::optional<MeasuredInverseDepth>> DepthSensor::measure(
    const Frame& frame, const RectificationError& rectification,
    const std::vector<Eigen::Vector2f>& px,
    const std::vector<std::optional<double>>& expected_px) const {
  const Camera& camera = calibration_.camera;
  std::vector<std::optional<MeasuredInverseDepth>> result(px.size());
  const auto ray_of = [&](std::size_t i) { return camera.unproject(px[i].cast<double>()); };
  if (calibration_.baseline_m > 0 && !frame.right.empty()) {
    const double per_px = 1 / (camera.fx * calibration_.baseline_m);
    const auto disparities = match_stereo(frame.image, frame.right, px, stereo_, expected_px);
    for (std::size_t i = 0; i < px.size(); ++i) {
      const auto ray = ray_of(i);
      if (!disparities[i] || !ray) continue;
      result[i] = {*ray, (*disparities[i] - rectification.at(ray->head<2>())) * per_px,
                   stereo_.sigma_disparity_px * per_px};
    }
  } else if (calibration_.depth && !frame.depth.empty()) {
    const auto depths = lookup_depth(frame.depth, camera, *calibration_.depth, px);
    for (std::size_t i = 0; i < px.size(); ++i)
      if (depths[i])
        result[i] = {ray_of(i).value_or(Eigen::Vector3d::UnitZ()), 1 / *depths[i],
                     calibration_.depth->sigma_at_1m};
  }
  return result;
}

std::vector<std::optional<MeasuredInverseDepth>> DepthSensor::measure_surfaces(
    const Frame& frame, const DepthCamera& depth, const std::vector<Eigen::Vector2f>& px) const {
  const Camera& camera = calibration_.camera;
  std::vector<std::optional<MeasuredInverseDepth>> result(px.size());
  if (frame.depth.empty()) return result;
  const auto surfaces = lookup_surfaces(frame.depth, camera, depth, px);
  for (std::size_t i = 0; i < px.size(); ++i) {
    const auto ray = camera.unproject(px[i].cast<double>());
    if (!surfaces[i] || !ray) continue;
    result[i] = {*ray, 1 / surfaces[i]->depth_m, depth.sigma_at_1m,
                 plane_through(camera, *ray, *surfaces[i])};
  }
  return result;
}

std::optional<double> DepthSensor::disparity_px(const Eigen::Vector3d& point_cam,
                                                const RectificationError& rectification) const {
  if (!(point_cam.z() > 0) || calibration_.baseline_m <= 0) return std::nullopt;
  return calibration_.camera.fx * calibration_.baseline_m / point_cam.z() +
         rectification.at(point_cam.head<2>() / point_cam.z());
}

std::vector<std::optional<double>> DepthSensor::disparities_px(
    const std::vector<Eigen::Vector2f>& px, const std::vector<double>& inverse_depths,
    const RectificationError& rectification) const {
  std::vector<std::optional<double>> result;
  if (calibration_.baseline_m <= 0) return result;
  const double px_per_inverse = calibration_.camera.fx * calibration_.baseline_m;
  for (std::size_t i = 0; i < inverse_depths.size(); ++i) {
    const auto ray = calibration_.camera.unproject(px[i].cast<double>());
    if (ray)
      result.push_back(inverse_depths[i] * px_per_inverse + rectification.at(ray->head<2>()));
    else
      result.push_back(std::nullopt);
  }
  return result;
}

}  // namespace placegraph
