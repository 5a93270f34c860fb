#pragma once
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <optional>

namespace placegraph {

/// Ground in an image, according to labels and edges.
struct GroundMask {
  Image mask;  ///< 0 = not the ground, CV_8UC1 of the image's size; empty: all pixels may be ground
  /// Normal of the ground (unit, down, in the camera) if edges show that it is a level floor.
  std::optional<Eigen::Vector3d> level;
  /// Standard deviation of either tilt of `level`, from the noise of the edges.
  double level_sigma_rad = 0;
};

}  // namespace placegraph
