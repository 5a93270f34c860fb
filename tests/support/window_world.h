#pragma once
#include <placegraph/backend/sliding_window.h>
#include <placegraph/graph/core/random.h>

#include <map>

namespace placegraph::test {

/// A camera that drives along a gentle curve through a cloud of points, and what it sees.
struct WindowWorldOptions {
  int keyframes = 8;
  int landmarks = 120;
  int views_per_landmark = 5;  ///< each point is seen in so many consecutive keyframes
  double noise_px = 0;
  double sigma_px = 1;  ///< what the observations claim
  bool stereo = false;  ///< with inverse depth, sigma = sigma_px / (fx 0.5 m)
  double step_m = 0.8;
};

struct WindowWorld {
  Camera camera;
  std::vector<SE3> T_map_cam;
  std::vector<Eigen::Vector3d> points;
  std::vector<WindowObservation> observations;  ///< by landmark, then keyframe
};

inline Camera window_camera() {
  Camera camera;
  camera.width = 1241;
  camera.height = 376;
  camera.fx = camera.fy = 718;
  camera.cx = 607;
  camera.cy = 185;
  return camera;
}

inline WindowWorld make_window_world(const WindowWorldOptions& options, Random& random) {
  WindowWorld world;
  world.camera = window_camera();
  for (int k = 0; k < options.keyframes; ++k) {
    const double yaw = 0.03 * k;
    world.T_map_cam.emplace_back(
        SO3::exp({0.01 * (k % 3), yaw, 0.005 * (k % 2)}),
        Eigen::Vector3d(0.1 * k * k * options.step_m * 0.2, 0.02 * (k % 2), options.step_m * k));
  }
  const double disparity_per_inverse_depth = world.camera.fx * 0.5;
  const int starts = std::max(1, options.keyframes - options.views_per_landmark + 1);
  while (static_cast<int>(world.points.size()) < options.landmarks) {
    // Drawn in the first keyframe that sees it, in front of the last one too.
    const int first = static_cast<int>(world.points.size()) % starts;
    const int last = std::min(options.keyframes, first + options.views_per_landmark) - 1;
    const double depth_m = random.uniform(6, 30);
    const Eigen::Vector3d p_cam(depth_m * random.uniform(-0.6, 0.6),
                                depth_m * random.uniform(-0.2, 0.2), depth_m);
    const Eigen::Vector3d p_map = world.T_map_cam[static_cast<std::size_t>(last)] * p_cam;
    const auto landmark = static_cast<std::int64_t>(world.points.size());
    for (int k = first; k <= last; ++k) {
      const Eigen::Vector3d p = world.T_map_cam[static_cast<std::size_t>(k)].inverse() * p_map;
      WindowObservation o;
      o.keyframe = k;
      o.landmark = landmark;
      o.px = *world.camera.project(p);
      o.px[0] += options.noise_px * random.normal();
      o.px[1] += options.noise_px * random.normal();
      o.sigma_px = options.sigma_px;
      if (options.stereo) {
        o.sigma_inverse_depth = options.sigma_px / disparity_per_inverse_depth;
        o.inverse_depth =
            1.0 / p[2] + options.noise_px / disparity_per_inverse_depth * random.normal();
      }
      world.observations.push_back(o);
    }
    world.points.push_back(p_map);
  }
  return world;
}

/// A small random motion [m], [rad].
inline SE3 random_motion(Random& random, double sigma_m, double sigma_rad) {
  Vector6d xi;
  for (int i = 0; i < 6; ++i) xi[i] = random.normal() * (i < 3 ? sigma_m : sigma_rad);
  return SE3::exp(xi);
}

/// Puts the world into a window, the start disturbed (the first keyframe is exact).
inline void fill_window(SlidingWindow& window, const WindowWorld& world, Random& random,
                        double sigma_m, double sigma_rad, double sigma_point_m) {
  for (std::size_t k = 0; k < world.T_map_cam.size(); ++k)
    window.add_keyframe(static_cast<std::int64_t>(k),
                        k == 0 ? world.T_map_cam[k]
                               : world.T_map_cam[k] * random_motion(random, sigma_m, sigma_rad));
  for (std::size_t i = 0; i < world.points.size(); ++i)
    window.add_landmark(
        static_cast<std::int64_t>(i),
        world.points[i] +
            sigma_point_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal()));
  for (const WindowObservation& o : world.observations) window.add_observation(o);
}

inline double distance_m(const SE3& a, const SE3& b) {
  return (a.translation() - b.translation()).norm();
}
inline double angle_rad(const SE3& a, const SE3& b) {
  return (a.rotation().inverse() * b.rotation()).log().norm();
}

}  // namespace placegraph::test
