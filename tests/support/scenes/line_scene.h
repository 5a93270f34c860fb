#pragma once
#include <placegraph/frontend/lines/line_triangulation.h>
#include <placegraph/graph/core/random.h>

#include <vector>

#include "tests/support/scenes/scene.h"

namespace placegraph::test {

/// Segments of space before a camera at the origin, and how cameras see them: ends drawn anew in
/// every view, edges measured every `step_px` with `noise_px` across.
struct LineScene {
  Camera camera = pinhole(640, 480, 500);
  std::vector<Eigen::Vector3d> from, to;  ///< of the reference frame

  Line3 line(std::size_t i) const { return Line3::from_direction(from[i], to[i] - from[i]); }

  /// Independent points on the image of line i, as an edge's fit gives them; nothing if it is not
  /// seen over 20 px at least.
  std::optional<ImageLine::Carriers> seen(std::size_t i, const SE3& T_ref_cam, double noise_px,
                                          Random& random, double step_px = 2) const {
    const SE3 T_cam_ref = T_ref_cam.inverse();
    const double a = random.uniform(0, 0.2), b = random.uniform(0.8, 1);
    const auto start = camera.project(T_cam_ref * (from[i] + a * (to[i] - from[i])));
    const auto end = camera.project(T_cam_ref * (from[i] + b * (to[i] - from[i])));
    if (!start || !end || (*end - *start).norm() < 20) return std::nullopt;
    const LineSegment whole{*start, *end};
    std::vector<Eigen::Vector2d> px;
    for (double s = 0; s < whole.length(); s += step_px)
      px.push_back(*start + s * whole.direction() + noise_px * random.normal() * whole.normal());
    const auto fitted = fit_line(px, std::vector<double>(px.size(), std::max(1e-6, noise_px)));
    if (!fitted) return std::nullopt;
    return fitted->carriers();
  }
};

/// `count` segments of 1 to 3 m in all directions, 4 to 10 m away.
inline LineScene random_lines(int count, Random& random) {
  LineScene scene;
  for (int i = 0; i < count; ++i) {
    const double z = random.uniform(4, 10);
    const Eigen::Vector3d middle(z * random.uniform(-0.4, 0.4), z * random.uniform(-0.3, 0.3), z);
    const Eigen::Vector3d half =
        random.uniform(0.5, 1.5) *
        Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    scene.from.push_back(middle - half);
    scene.to.push_back(middle + half);
  }
  return scene;
}

}  // namespace placegraph::test
