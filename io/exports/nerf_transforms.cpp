#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/exports/nerf_transforms.h>

#include <nlohmann/json.hpp>

namespace placegraph {

std::string to_nerf_transforms(const Camera& camera, const std::vector<NerfImage>& images) {
  camera.check();
  require(camera.distortion == Distortion::kNone, "transforms.json: the camera has a distortion");
  constexpr double kToCorner_px = 0.5;  // pixels count from the corner of the first one
  nlohmann::ordered_json json = {{"camera_model", "PINHOLE"},
                                 {"fl_x", camera.fx},
                                 {"fl_y", camera.fy},
                                 {"cx", camera.cx + kToCorner_px},
                                 {"cy", camera.cy + kToCorner_px},
                                 {"w", camera.width},
                                 {"h", camera.height},
                                 {"frames", nlohmann::ordered_json::array()}};
  const Eigen::Vector4d to_opengl(1, -1, -1, 1);
  for (const NerfImage& image : images) {
    const Eigen::Matrix4d T = image.T_world_cam.matrix() * to_opengl.asDiagonal();
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (int i = 0; i < 4; ++i) rows.push_back({T(i, 0), T(i, 1), T(i, 2), T(i, 3)});
    json["frames"].push_back({{"file_path", image.path}, {"transform_matrix", rows}});
  }
  return json_text(json, 1);
}

}  // namespace placegraph
