#pragma once
#include <placegraph/graph/scene/street_map.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace placegraph {

struct StreetMapPicture {
  std::string title;
  /// The path of the camera, x and z in the plan frame; a lost frame leaves a gap in the line.
  std::vector<std::optional<Eigen::Vector2d>> path;
};

/// The top view in the colours of its classes as SVG text: x to the right, z up, with a legend and
/// the path of the camera. Unknown cells are white.
std::string street_map_svg(const StreetMap& map, const StreetMapPicture& picture);

}  // namespace placegraph
