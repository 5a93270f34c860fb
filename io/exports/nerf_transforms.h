#pragma once
#include <placegraph/graph/geometry/camera.h>

#include <string>
#include <vector>

namespace placegraph {

/// A posed image for programs that learn radiance fields.
struct NerfImage {
  std::string path;  ///< path of the image, from the folder of the exported file
  SE3 T_world_cam;   ///< pose of its camera (x right, y down, z forward)
};

/// The text of a transforms.json: camera, and camera-to-world matrices of cameras in OpenGL's axes
/// (x right, y up, z back). Pixels count from the corner of the first one. Throws ArgumentError if
/// the camera has a distortion.
std::string to_nerf_transforms(const Camera& camera, const std::vector<NerfImage>& images);

}  // namespace placegraph
