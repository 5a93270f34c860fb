#include <placegraph/io/synthetic/render/hash_noise.h>
#include <placegraph/io/synthetic/worlds/indoor_walk.h>

#include <algorithm>

namespace placegraph::synthetic {

Camera indoor_camera() {
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 525;
  camera.cx = 319.5;
  camera.cy = 239.5;
  return camera;
}

void walk_through(const BuildingLayout& plan, const IndoorWalk& walk, std::uint32_t seed,
                  Tour& tour) {
  constexpr double kStep_m = 0.05;
  const std::vector<Eigen::Vector2d> path =
      smooth_path(walk.corners, kStep_m, walk.rotation_window_m);
  const SpeedLimits limits{walk.speed_mps, 0.5, 0.5};
  const std::vector<double> positions = drive_positions(path, kStep_m, limits, 0.1);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double t = 0.1 * static_cast<double>(i);
    const double ramp = std::min(1.0, 0.2 * t);  // level and straight at the start
    const auto sway = [&](double rate, std::uint32_t salt) {
      return ramp * value_noise(t * rate, 0.5, seed + salt);
    };
    // The direction is that of the path a little ahead, because a walker looks into a bend before.
    const PathPoint here = path_point(path, kStep_m, positions[i]);
    const PathPoint ahead = path_point(path, kStep_m, positions[i] + 0.3);
    const Eigen::Vector2d side(here.direction[1], -here.direction[0]);
    const Eigen::Vector2d p = here.position + 0.02 * sway(0.9, 1) * side;
    const Eigen::Matrix3d R = camera_axes({ahead.direction[0], 0, ahead.direction[1]}, {0, -1, 0},
                                          0.025 * sway(0.7, 2) + 0.006 * sway(2.7, 3),
                                          0.05 * sway(0.5, 4), 0.02 * sway(0.8, 5));
    tour.time_s.push_back(t);
    tour.T_scene_cam.emplace_back(R, Eigen::Vector3d(p[0], -walk.camera_height_m, p[1]));
  }
  tour.camera = indoor_camera();
  tour.baseline_m = kIndoorBaseline_m;
  tour.camera_height_m = walk.camera_height_m;
  const Eigen::Vector3d first = tour.T_scene_cam.front().translation();
  tour.floor_plan = to_json(plan, {first[0], first[2]}, walk.camera_height_m);
}

}  // namespace placegraph::synthetic
