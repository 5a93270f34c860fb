#pragma once
#include <placegraph/frontend/lines/line_initializer.h>

#include "tests/support/scenes/line_scene.h"

namespace placegraph::test {

/// Edges of a corridor along z, 3 m wide, its floor 1.4 m below the camera and its ceiling 1.3 m
/// above it: seams along the walls, joints across the floor and the ceiling, door frames that stand
/// on the floor, shelves at 0.5 m below the camera.
inline LineScene corridor_lines() {
  LineScene scene;
  const auto add = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    scene.from.push_back(a);
    scene.to.push_back(b);
  };
  for (const double x : {-1.5, -0.7, 0.6, 1.5})
    for (const double y : {1.4, -1.3}) add({x, y, 3}, {x, y, 9});
  for (const double z : {3.5, 4.2, 5.0, 6.1, 7.3})
    for (const double y : {1.4, -1.3}) add({-1.4, y, z}, {1.4, y, z});
  for (const double z : {4.0, 5.2, 6.5})
    for (const double x : {-1.5, 1.5}) {
      add({x, -0.7, z}, {x, 1.4, z});
      add({x, -0.7, z + 0.9}, {x, 1.4, z + 0.9});
      add({x, 0.5, z - 0.6}, {0.8 * x, 0.5, z - 0.6});
    }
  return scene;
}

/// The lines that are seen from `T_ref_cam`, by their numbers.
inline LineView view_of(const LineScene& scene, const SE3& T_ref_cam, double noise_px,
                        Random& random) {
  LineView view;
  for (std::size_t i = 0; i < scene.from.size(); ++i)
    if (const auto seen = scene.seen(i, T_ref_cam, noise_px, random))
      view[LineId(i)] = {{seen->first, seen->second}, *seen};
  return view;
}

}  // namespace placegraph::test
