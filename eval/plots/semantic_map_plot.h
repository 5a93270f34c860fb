#pragma once
#include <placegraph/graph/scene/semantic_map.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace placegraph {

struct SemanticMapPicture {
  std::string title;
  /// The path of the camera, x and z in the plan frame; a lost frame leaves a gap in the line.
  std::vector<std::optional<Eigen::Vector2d>> path;
};

/// The top view in the colours of its classes as SVG text: x to the right, z up, with a legend and
/// the path of the camera. Unknown cells are white.
std::string semantic_map_svg(const SemanticMap& map, const SemanticMapPicture& picture);

}  // namespace placegraph
