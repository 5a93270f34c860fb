#pragma once
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line_segment.h>
#include <placegraph/graph/geometry/so3.h>

#include <Eigen/Dense>
#include <numbers>
#include <optional>
#include <vector>

namespace placegraph::test {

inline Camera vanishing_camera() {
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 520;
  camera.cx = 322;
  camera.cy = 237;
  return camera;
}

inline SO3 random_rotation(double max_rad, Random& random) {
  const Eigen::Vector3d axis(random.normal(), random.normal(), random.normal());
  return SO3::exp(axis.normalized() * random.uniform(0, max_rad));
}

/// A segment of an edge of the scene along `direction`, its ends off by `noise_px`; nothing where
/// it leaves the image or is short.
inline std::optional<LineSegment> seen_edge(const Camera& camera, const Eigen::Vector3d& direction,
                                            double noise_px, Random& random) {
  const Eigen::Vector2d px(random.uniform(0, camera.width - 1),
                           random.uniform(0, camera.height - 1));
  const Eigen::Vector3d middle = *camera.unproject(px) * random.uniform(2, 12);
  const double half = random.uniform(0.1, 1.5);
  const auto a = camera.project(middle - half * direction);
  const auto b = camera.project(middle + half * direction);
  if (!a || !b || !camera.contains(*a) || !camera.contains(*b) || (*a - *b).norm() < 20)
    return std::nullopt;
  const auto noise = [&] {
    return Eigen::Vector2d(random.normal(0, noise_px), random.normal(0, noise_px));
  };
  return LineSegment{*a + noise(), *b + noise()};
}

/// `count` of them, appended.
inline void add_edges(const Camera& camera, const Eigen::Vector3d& direction, int count,
                      double noise_px, Random& random, std::vector<LineSegment>& segments) {
  while (count > 0) {
    const auto segment = seen_edge(camera, direction, noise_px, random);
    if (!segment) continue;
    segments.push_back(*segment);
    --count;
  }
}

/// Segments that point anywhere: foliage.
inline void add_clutter(const Camera& camera, int count, Random& random,
                        std::vector<LineSegment>& segments) {
  while (count > 0) {
    const double angle = random.uniform(0, std::numbers::pi), length = random.uniform(20, 80);
    const Eigen::Vector2d px(random.uniform(0, camera.width - 1),
                             random.uniform(0, camera.height - 1));
    const Eigen::Vector2d half = 0.5 * length * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    if (!camera.contains(px - half) || !camera.contains(px + half)) continue;
    segments.push_back({px - half, px + half});
    --count;
  }
}

/// A rectangular world: `per_axis` edges along each axis and clutter.
inline std::vector<LineSegment> manhattan_segments(const Camera& camera, const SO3& R_cam_manhattan,
                                                   int per_axis, int clutter, double noise_px,
                                                   Random& random) {
  std::vector<LineSegment> segments;
  for (int a = 0; a < 3; ++a)
    add_edges(camera, R_cam_manhattan.matrix().col(a), per_axis, noise_px, random, segments);
  add_clutter(camera, clutter, random, segments);
  return segments;
}

}  // namespace placegraph::test
