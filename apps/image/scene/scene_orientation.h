#pragma once
#include <placegraph/frontend/scene/orientation_map.h>
#include "apps/image/scene/orientation_check.h"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace placegraph::apps {

struct SceneOrientationArguments {
  std::string in;          ///< image, or folder of a sequence
  std::string camera;      ///< calibration file; empty: the calibration of the sequence
  std::string out;         ///< file for the map, or folder for the maps; empty: none
  bool ids = false;        ///< the maps have numbers, not colours with a legend
  std::string drawing;     ///< file for a drawing of surfaces and edges, or folder; empty: none
  int every = 1;           ///< use every n-th image of a sequence
  std::uint64_t seed = 1;  ///< seed of the random samples
  bool force = false;      ///< overwrite existing outputs
  OrientationMapOptions options;
};

/// Result of one image; shares of its pixels.
struct ImageOrientation {
  double coverage = 0;  ///< share of labelled pixels
  double floor = 0, ceiling = 0, wall = 0;
  int vertical_axis = 0;  ///< column of `R_cam_manhattan`
  Eigen::Matrix3d R_cam_manhattan = Eigen::Matrix3d::Identity();
};

/// Result of the images of a sequence.
struct SequenceOrientation {
  int images = 0, labelled = 0;
  double coverage = 0;                    ///< mean share of labelled pixels
  std::optional<OrientationCheck> check;  ///< set if the sequence has true surfaces
};

struct SceneOrientationResult {
  std::string in;
  std::variant<ImageOrientation, SequenceOrientation> found;
  double cpu_ms = 0;                     ///< CPU time per image
  std::optional<std::string> no_result;  ///< reason if no image has a Manhattan frame
};

/// Estimates the orientation of surfaces from straight edges: `image orientation`.
/// Writes maps and drawings. Throws ArgumentError, FileError, and NoResult if a single image has no
/// Manhattan frame.
SceneOrientationResult scene_orientation(const SceneOrientationArguments& arguments);

/// One line.
std::string to_text(const SceneOrientationResult& result);
std::string to_json(const SceneOrientationResult& result);

}  // namespace placegraph::apps
