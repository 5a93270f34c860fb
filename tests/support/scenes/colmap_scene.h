#pragma once
#include <placegraph/io/exports/colmap_model.h>

#include <string>

#include "tests/support/scenes/observed_map.h"
#include "tests/support/scenes/poses.h"

namespace placegraph::test {

/// A COLMAP model of a scene with exact observations by a camera, and disturbed poses.
inline ColmapModel disturbed_colmap_model(const PointScene& scene, const Camera& camera,
                                          Random& random) {
  ColmapModel model;
  model.camera = camera;
  for (std::size_t k = 0; k < scene.points_ref.size(); ++k)
    model.points.push_back({k + 1, scene.points_ref[k], {}, -1});
  for (std::size_t i = 0; i < scene.T_ref_cam.size(); ++i) {
    ColmapModel::Image& image = model.images.emplace_back();
    image.id = static_cast<std::uint32_t>(i + 1);
    image.name = std::to_string(i) + ".png";
    image.T_world_cam = scene.T_ref_cam[i];
    for (std::size_t k = 0; k < scene.points_ref.size(); ++k)
      if (const auto px = camera.project(scene.T_ref_cam[i].inverse() * scene.points_ref[k]))
        image.observations.push_back({*px, static_cast<int>(k)});
    image.T_world_cam = image.T_world_cam * random_motion(random, 0.01, 0.004);
  }
  return model;
}

}  // namespace placegraph::test
