#pragma once
#include <placegraph/frontend/scene/horizon.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

struct ScenePopupArguments {
  std::string image;        ///< image without distortion
  std::string out;          ///< file for the mesh, PLY, in the camera frame [m]
  std::string calib;        ///< calibration file; empty: a lens of about 58 degrees is assumed
  std::string model;        ///< model of surfaces; empty: the installed one
  std::string surfaces;     ///< label image to use instead of the model; empty: none
  std::string draw;         ///< file for the image with the box; empty: none
  std::string mask;         ///< file for the mask of the box, visible 255, hidden 128; empty: none
  double height_m = 1.5;    ///< height of the camera above the ground
  double farthest_m = 100;  ///< largest distance of a surface; only the sky is farther
  std::vector<double> box;  ///< box as right, forward, width, depth, height [m]; empty: none
  std::uint64_t seed = 1;   ///< seed of the search for vanishing points
  bool level = false;       ///< assume a level camera; ignore the edges
  bool force = false;       ///< overwrite existing files
  HorizonOptions horizon;
};

/// The box in the image.
struct PlacedBox {
  Eigen::Vector2d foot_px;         ///< centre of its bottom face
  int seen_px = 0, hidden_px = 0;  ///< visible and hidden pixels
};

struct ScenePopupResult {
  std::string image, out;
  Eigen::Vector3d down = Eigen::Vector3d::UnitY();  ///< unit vector in the camera frame
  bool horizon_from_lines = false;
  double horizon_row = 0;             ///< row of the horizon in the middle column [px]
  std::optional<PlacedBox> box = {};  ///< set if a box was requested
};

/// Makes a 3D model of planes from one image and inserts a box: `image popup`.
/// Writes the mesh and the image with the box. Throws ArgumentError, FileError.
ScenePopupResult scene_popup(const ScenePopupArguments& arguments);

/// One line.
std::string to_text(const ScenePopupResult& result);
std::string to_json(const ScenePopupResult& result);

}  // namespace placegraph::apps
