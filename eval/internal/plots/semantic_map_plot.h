#pragma once
#include <placegraph/graph/scene/semantic_map.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace placegraph {

struct SemanticMapPicture {
  std::string title;
  /// The way of the camera, x and z in the plan frame; where it is lost the line has a gap.
  std::vector<std::optional<Eigen::Vector2d>> path;
};

/// The top view in the colours of its classes as PNG bytes: x to the right, z up, with a legend, a
/// bar of 10 m and the way of the camera. Cells that are unknown are white.
std::string semantic_map_png(const SemanticMap& map, const SemanticMapPicture& picture);

}  // namespace placegraph
