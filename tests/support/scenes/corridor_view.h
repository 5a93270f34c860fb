#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line_segment.h>
#include <placegraph/graph/geometry/so3.h>

#include <vector>

namespace placegraph::test {

/// The edges that one view shows of a corridor along z, its floor 1.4 m below the camera: doors on
/// its walls, joints across its floor, and skirting boards 10 cm high.
struct CorridorView {
  static constexpr double kHeight_m = 1.4, kHalfWidth_m = 1.2, kBoard_m = 0.1;
  Camera camera;
  std::vector<LineSegment> segments;
  std::vector<int> axis;
  SO3 R_cam_manhattan = SO3::exp({0.03, 0.1, 0});

  /// `lower_edge`: whether that of the boards is seen.
  explicit CorridorView(bool lower_edge) {
    camera.width = 640, camera.height = 480;
    camera.fx = camera.fy = 500, camera.cx = 319.5, camera.cy = 239.5;
    for (const double x : {-kHalfWidth_m, kHalfWidth_m}) {
      add({x, kHeight_m - kBoard_m, 2.5}, {x, kHeight_m - kBoard_m, 8}, 2);
      if (lower_edge) add({x, kHeight_m, 2.5}, {x, kHeight_m, 8}, 2);
      add({x, -1, 2.5}, {x, -1, 8}, 2);
      for (double z = 2.6; z < 8; z += 0.6) add({x, -1, z}, {x, kHeight_m - kBoard_m, z}, 1);
    }
    for (double z = 2.9; z < 8; z += 0.5)
      add({-kHalfWidth_m, kHeight_m, z}, {kHalfWidth_m, kHeight_m, z}, 0);
  }
  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, int along) {
    const auto p = camera.project(R_cam_manhattan * a), q = camera.project(R_cam_manhattan * b);
    if (!p || !q) return;
    segments.push_back({*p, *q});
    axis.push_back(along);
  }
};

}  // namespace placegraph::test
