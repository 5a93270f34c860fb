#pragma once
#include <gtest/gtest.h>
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/graph/core/random.h>

#include <Eigen/Cholesky>
#include <map>

#include "tests/support/scenes/poses.h"

namespace placegraph::test {

/// A camera that drives along a gentle curve through a cloud of points and lines over flat ground,
/// and what it sees. The first `ground_points` of the points lie on the ground.
struct WindowWorldOptions {
  int keyframes = 8;
  int landmarks = 120;
  int views_per_landmark = 5;  ///< each point is seen in so many consecutive keyframes
  double noise_px = 0;
  double sigma_px = 1;  ///< what the observations claim
  bool stereo = false;  ///< with inverse depth, sigma = sigma_px / (fx 0.5 m)
  double step_m = 0.8;
  int lines = 0;
  int ground_points = 0;
  double sigma_ground_m = 0.02;  ///< how uneven the ground is, where there is noise
  double sigma_height_m = 0;     ///< of the measured heights above the ground; 0: none is measured
  /// So many planes about the way, no two parallel, are measured in every keyframe.
  int planes = 0;
  double sigma_plane_rad = 0.005, sigma_plane_m = 0.05;
};

struct WindowWorld {
  Camera camera;
  std::vector<SE3> T_map_cam;
  std::vector<Eigen::Vector3d> points;
  std::vector<WindowObservation> observations;  ///< by landmark, then keyframe
  std::vector<Line3> lines;
  std::vector<LineObservation> segments;  ///< by line, then keyframe
  Plane3 ground{Eigen::Vector3d::UnitY(), 1.65};
  std::vector<HeightObservation> heights;  ///< by keyframe, plane 0
  int ground_points = 0;
  double sigma_ground_m = 0;
  std::vector<Plane3> planes;                 ///< ids from kFirstPlane on
  std::vector<PlaneObservation> planes_seen;  ///< by plane, then keyframe

  static constexpr std::int64_t kFirstPlane = 10;
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

/// Lines of random directions whose planes through the cameras turn by 3 degrees or more, their
/// ends drawn anew in every keyframe that sees them.
inline void add_lines(WindowWorld& world, const WindowWorldOptions& options, Random& random) {
  const int starts = std::max(1, options.keyframes - options.views_per_landmark + 1);
  for (int i = 0; i < options.lines; ++i) {
    const int first = i % starts;
    const int last = std::min(options.keyframes, first + options.views_per_landmark) - 1;
    Eigen::Vector3d middle, direction;
    const auto plane_seen_from = [&](int k) -> Eigen::Vector3d {
      return (middle - world.T_map_cam[static_cast<std::size_t>(k)].translation())
          .cross(direction)
          .normalized();
    };
    do {
      const double depth_m = random.uniform(8, 20);
      const Eigen::Vector3d middle_cam(depth_m * random.uniform(-0.5, 0.5),
                                       depth_m * random.uniform(-0.2, 0.2), depth_m);
      middle = world.T_map_cam[static_cast<std::size_t>(last)] * middle_cam;
      direction =
          Eigen::Vector3d(random.normal(), random.normal(), 0.3 * random.normal()).normalized();
    } while (plane_seen_from(first).cross(plane_seen_from(last)).norm() < std::sin(0.05));
    world.lines.push_back(Line3::from_direction(middle, direction));
    for (int k = first; k <= last; ++k) {
      const SE3 T_cam_map = world.T_map_cam[static_cast<std::size_t>(k)].inverse();
      LineObservation o{KeyframeId(k), LineId(i), {}, {}, options.sigma_px, {}};
      for (Eigen::Vector2d* end : {&o.start_px, &o.end_px}) {
        const double along_m = (end == &o.start_px ? -1 : 1) * random.uniform(1, 2.5);
        *end = *world.camera.project(T_cam_map * (middle + along_m * direction));
        *end += options.noise_px * Eigen::Vector2d(random.normal(), random.normal());
      }
      world.segments.push_back(o);
    }
  }
}

/// Planes about the way, measured in every keyframe.
inline void add_planes(WindowWorld& world, const WindowWorldOptions& options, Random& random) {
  for (int i = 0; i < options.planes; ++i) {
    const double rotation = 0.2 + 2.4 * i / options.planes;
    const Plane3 plane({std::cos(rotation), 0.1 * (i + 1), std::sin(rotation)}, -4 - 2 * i);
    world.planes.push_back(plane);
    for (int k = 0; k < options.keyframes; ++k) {
      const Plane3 plane_cam = transform_to(world.T_map_cam[static_cast<std::size_t>(k)], plane);
      PlaneObservation o{
          KeyframeId(k), PlaneId(WindowWorld::kFirstPlane + i), plane_cam,
          plane_information(plane_cam, options.sigma_plane_rad, options.sigma_plane_m)};
      const Eigen::LLT<Eigen::Matrix3d> llt(o.information);
      Eigen::Vector3d noise;
      for (int j = 0; j < 3; ++j) noise[j] = options.noise_px / options.sigma_px * random.normal();
      o.plane_cam = plane_cam.plus(llt.matrixU().solve(noise));
      world.planes_seen.push_back(o);
    }
  }
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
    Eigen::Vector3d p_map = world.T_map_cam[static_cast<std::size_t>(last)] * p_cam;
    if (static_cast<int>(world.points.size()) < options.ground_points)
      p_map -= (world.ground.distance_to(p_map) +
                (options.noise_px > 0 ? options.sigma_ground_m * random.normal() : 0)) *
               world.ground.normal();
    const LandmarkId landmark(world.points.size());
    for (int k = first; k <= last; ++k) {
      const Eigen::Vector3d p = world.T_map_cam[static_cast<std::size_t>(k)].inverse() * p_map;
      WindowObservation o;
      o.keyframe = KeyframeId(k);
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
  world.ground_points = options.ground_points;
  world.sigma_ground_m = options.sigma_ground_m;
  add_lines(world, options, random);
  for (int k = 0; k < options.keyframes && options.sigma_height_m > 0; ++k) {
    const double height_m = std::abs(
        world.ground.distance_to(world.T_map_cam[static_cast<std::size_t>(k)].translation()));
    const double noise = options.noise_px > 0 ? options.sigma_height_m * random.normal() : 0;
    world.heights.push_back({KeyframeId(k), PlaneId(0), height_m + noise, options.sigma_height_m});
  }
  add_planes(world, options, random);
  return world;
}

/// Puts the world into a window, the start disturbed (the first keyframe is exact).
inline void fill_window(SlidingWindow& window, const WindowWorld& world, Random& random,
                        double sigma_m, double sigma_rad, double sigma_point_m) {
  for (std::size_t k = 0; k < world.T_map_cam.size(); ++k)
    window.add_keyframe(KeyframeId(k),
                        k == 0 ? world.T_map_cam[k]
                               : world.T_map_cam[k] * random_motion(random, sigma_m, sigma_rad));
  for (std::size_t i = 0; i < world.points.size(); ++i)
    window.add_landmark(
        LandmarkId(i),
        world.points[i] +
            sigma_point_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal()));
  for (const WindowObservation& o : world.observations) window.add_observation(o);
}

/// How a window is driven through a world.
struct WindowDrive {
  SlidingWindowOptions options;
  double disturbance = 1;          ///< of the starts: 1 = 2 cm, 2 mrad a step, 10 cm a point
  std::optional<KeyframeId> kept;  ///< a keyframe that stays

  /// For comparisons with batches: to the minimum, and normal noise as it is.
  static WindowDrive exact(int max_keyframes) {
    WindowDrive drive;
    drive.options.max_keyframes = max_keyframes;
    drive.options.max_iterations = 50;
    drive.options.relative_decrease = 1e-15;
    drive.options.huber_px = 50;
    return drive;
  }
};

/// Puts what keyframe `id` sees into the window; landmarks start disturbed when first seen.
inline void add_view(SlidingWindow& window, const WindowWorld& world, KeyframeId id,
                     double disturbance, Random& random) {
  if (id == KeyframeId(0) && !world.heights.empty()) window.add_plane(PlaneId(0), world.ground);
  for (const WindowObservation& o : world.observations) {
    if (o.keyframe != id) continue;
    if (!window.landmark(o.landmark)) {
      Eigen::Vector3d p_map = world.points[static_cast<std::size_t>(o.landmark.value())];
      for (int i = 0; i < 3; ++i) p_map[i] += 0.1 * disturbance * random.normal();
      window.add_landmark(o.landmark, p_map);
      if (o.landmark.value() < world.ground_points && !world.heights.empty())
        window.add_plane_point({PlaneId(0), o.landmark, world.sigma_ground_m});
    }
    window.add_observation(o);
  }
  for (const LineObservation& o : world.segments) {
    if (o.keyframe != id) continue;
    if (!window.line(o.line)) {
      Line3::Tangent step;
      for (int i = 0; i < 4; ++i) step[i] = (i < 3 ? 0.01 : 1e-3) * disturbance * random.normal();
      window.add_line(o.line, world.lines[static_cast<std::size_t>(o.line.value())].plus(step));
    }
    window.add_line_observation(o);
  }
  for (const HeightObservation& h : world.heights)
    if (h.keyframe == id) add_height(window, h);
  for (const PlaneObservation& o : world.planes_seen) {
    if (o.keyframe != id) continue;
    if (!window.plane(o.plane)) {
      Eigen::Vector3d step;
      for (int i = 0; i < 3; ++i) step[i] = 0.01 * disturbance * random.normal();
      const auto which = static_cast<std::size_t>(o.plane.value() - WindowWorld::kFirstPlane);
      window.add_plane(o.plane, world.planes[which].plus(step));
    }
    add_plane_observation(window, o);
  }
}

/// Drives through the world keyframe by keyframe; each starts from the last pose and the true
/// motion, disturbed.
inline SlidingWindow drive_window(const WindowWorld& world, const WindowDrive& drive,
                                  std::uint64_t seed) {
  Random random(seed);
  SlidingWindow window(drive.options, world.camera);
  for (std::size_t k = 0; k < world.T_map_cam.size(); ++k) {
    const KeyframeId id(k);
    SE3 T_map_cam = world.T_map_cam[k];
    if (k > 0)
      T_map_cam = window.pose(KeyframeId(k - 1)) *
                  (world.T_map_cam[k - 1].inverse() * world.T_map_cam[k]) *
                  random_motion(random, 0.02 * drive.disturbance, 0.002 * drive.disturbance);
    window.add_keyframe(id, T_map_cam);
    if (id == drive.kept) window.keep(keyframe_variable(id));
    add_view(window, world, id, drive.disturbance, random);
    if (k > 0) {
      const WindowSummary summary = window.optimize();
      EXPECT_TRUE(summary.outcome) << summary.outcome.reason;
    }
    window.marginalize();
  }
  return window;
}

}  // namespace placegraph::test
