#pragma once
#include <placegraph/frontend/internal/scene/horizon.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

struct ScenePopupArguments {
  std::string image;        ///< without distortion
  std::string out;          ///< the mesh to write, PLY, in metres of the camera's frame
  std::string calib;        ///< the camera; empty: a lens of about 58 degrees is supposed
  std::string model;        ///< of surfaces; empty: the one that came with the program
  std::string surfaces;     ///< label image in place of the model's; empty: none
  std::string draw;         ///< the picture with the box in it, to write; empty: none
  std::string mask;         ///< where the box is seen (255) and hidden (128); empty: not written
  double height_m = 1.5;    ///< of the camera above the ground
  double farthest_m = 100;  ///< nothing but the sky is farther
  std::vector<double> box;  ///< right, forward, width, depth, height [m]; empty: none
  std::uint64_t seed = 1;   ///< of the search for vanishing points
  bool level = false;       ///< the camera is level: edges are not asked
  bool force = false;       ///< overwrite files
  HorizonOptions horizon;
};

/// What became of the box in the picture.
struct PlacedBox {
  Eigen::Vector2d foot_px;         ///< the middle of its foot
  int seen_px = 0, hidden_px = 0;  ///< pixels
};

struct ScenePopupResult {
  std::string image, out;
  Eigen::Vector3d down = Eigen::Vector3d::UnitY();  ///< unit, camera frame
  bool horizon_from_lines = false;
  double horizon_row = 0;             ///< where the horizon crosses the middle column [px]
  std::optional<PlacedBox> box = {};  ///< if one was asked for
};

/// `placegraph scene popup`: folds a picture up into space, writes the mesh, and puts a box into
/// it. Throws ArgumentError, FileError.
ScenePopupResult scene_popup(const ScenePopupArguments& arguments);

/// One line.
std::string to_text(const ScenePopupResult& result);
std::string to_json(const ScenePopupResult& result);

}  // namespace placegraph::apps
