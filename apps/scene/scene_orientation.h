#pragma once
#include <placegraph/eval/internal/scene/orientation_check.h>
#include <placegraph/frontend/internal/scene/orientation_map.h>

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace placegraph::apps {

struct SceneOrientationArguments {
  std::string in;          ///< an image, or the folder of a sequence
  std::string camera;      ///< calibration of the image; of a sequence its own where it is empty
  std::string out;         ///< map to write, or folder of them; empty: none
  std::string drawing;     ///< picture of surfaces and edges, or folder of them; empty: none
  int every = 1;           ///< of a sequence, every n-th image
  std::uint64_t seed = 1;  ///< of the random samples
  bool force = false;      ///< replace what is there
  OrientationMapOptions options;
};

/// Of one image; shares of its pixels.
struct ImageOrientation {
  double coverage = 0;  ///< that are told
  double floor = 0, ceiling = 0, wall = 0;
  int vertical_axis = 0;  ///< a column of `R_cam_manhattan`
  Eigen::Matrix3d R_cam_manhattan = Eigen::Matrix3d::Identity();
};

/// Of the images of a sequence.
struct SequenceOrientation {
  int images = 0, told = 0;
  double coverage = 0;                    ///< mean share of pixels that are told
  std::optional<OrientationCheck> check;  ///< where the sequence holds its surfaces
};

struct SceneOrientationResult {
  std::string in;
  std::variant<ImageOrientation, SequenceOrientation> found;
  double cpu_ms = 0;                     ///< an image
  std::optional<std::string> no_answer;  ///< no image of the sequence shows a rectangular world
};

/// `placegraph scene orientation`: how the surface behind each pixel is turned, from straight
/// edges; writes maps and drawings. Throws ArgumentError, FileError, and NoAnswer where the one
/// image shows no rectangular world.
SceneOrientationResult scene_orientation(const SceneOrientationArguments& arguments);

/// One line.
std::string to_text(const SceneOrientationResult& result);
std::string to_json(const SceneOrientationResult& result);

}  // namespace placegraph::apps
