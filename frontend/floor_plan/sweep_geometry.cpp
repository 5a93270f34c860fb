#include <placegraph/frontend/floor_plan/sweep_geometry.h>

#include <Eigen/LU>
#include <algorithm>

namespace placegraph {

SweepGeometry sweep_geometry(const Camera& camera, const std::vector<SE3>& T_view_cam,
                             const SweepRange& range) {
  SweepGeometry geometry{camera};
  const Eigen::Matrix3d K = camera.K(), K_inverse = K.inverse();
  for (const SE3& T : T_view_cam)
    geometry.views.push_back({K * T.rotation().matrix() * K_inverse, K * T.translation()});
  const double low = 1 / range.max_depth_m, high = 1 / range.min_depth_m;
  const double middle = 0.5 * (low + high);
  double fastest = 0;
  for (const SweepGeometry::View& view : geometry.views)
    for (const double across : {0.0, 0.5, 1.0})
      for (const double down : {0.0, 0.5, 1.0}) {
        const double u = across * (camera.width - 1), v = down * (camera.height - 1);
        if (view.at(u, v, middle)[2] >= SweepGeometry::kBehind)
          fastest = std::max(fastest, view.rate(u, v, middle));
      }
  geometry.levels = static_cast<int>(
      std::clamp(fastest * (high - low) / range.step_px, 0.0, 1.0 * range.max_levels));
  geometry.step = (high - low) / std::max(1, geometry.levels - 1);
  geometry.farthest = low;
  return geometry;
}

}  // namespace placegraph
