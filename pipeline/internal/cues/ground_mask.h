#pragma once
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <optional>

namespace placegraph {

/// What labels and edges tell of the ground in a view.
struct GroundMask {
  Image mask;  ///< 0 = not the ground, CV_8UC1 of the image's size; empty: all may be
  /// Its normal (unit, down, in the camera) where edges show it to be a level floor.
  std::optional<Eigen::Vector3d> level;
  double level_sigma_rad = 0;  ///< of either tilt of `level`, by the noise of the edges
};

}  // namespace placegraph
