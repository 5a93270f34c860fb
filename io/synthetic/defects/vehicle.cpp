#include <placegraph/io/synthetic/defects/vehicle.h>

namespace placegraph::synthetic {

SE3 on_undulation(const GroundMesh& ground, const SE3& T_scene_cam) {
  if (ground.undulation.empty()) return T_scene_cam;
  const Eigen::Vector3d p = T_scene_cam.translation(), z = T_scene_cam.rotation().matrix().col(2);
  const Eigen::Vector2d middle(p[0], p[2]), ahead = Eigen::Vector2d(z[0], z[2]).normalized(),
                                            right(ahead[1], -ahead[0]);
  double mean = 0, along = 0, across = 0;  // y points down: a positive height is a hollow
  for (const double i : {-0.5, 0.5}) {
    for (const double j : {-0.5, 0.5}) {
      const Eigen::Vector2d wheel = middle + i * kWheelbase_m * ahead + j * kTrackWidth_m * right;
      const double height = ground.undulation_at(wheel[0], wheel[1]);
      mean += 0.25 * height;
      along += i * height / kWheelbase_m;
      across += j * height / kTrackWidth_m;
    }
  }
  const SO3 tilt = SO3::exp({-along, 0, across});
  return SE3(T_scene_cam.rotation() * tilt, p + Eigen::Vector3d(0, mean, 0));
}

}  // namespace placegraph::synthetic
