#pragma once
#include <placegraph/frontend/internal/vanishing/manhattan_frame.h>
#include <placegraph/frontend/lines/line_options.h>

namespace placegraph {

/// What a vanishing point is to the rectangular worlds of its scene.
struct PointRole {
  int frame = -1, axis = -1;  ///< it is this axis of this world; -1: of none
  /// A point that is no axis: it lies at right angles to this axis of this world, as all level
  /// directions do to the upright one (Atlanta worlds), and slopes of a roof to the ridge.
  int across_frame = -1, across_axis = -1;
};

/// All that the segments of one image tell of the directions of its scene.
struct SceneDirections {
  VanishingPoints vanishing;
  std::vector<PointRole> roles;        ///< of vanishing.points
  std::vector<ManhattanFrame> frames;  ///< most evident first; empty where none is supported
};

/// Vanishing points and rectangular worlds together. A vanishing point that is an axis of a world
/// is held to it as closely as the axes of that world keep to right angles; an axis that enough
/// segments show, but not enough to be found without the others, is a vanishing point too.
/// Deterministic for a given `random`. Outcome and errors are those of find_vanishing_points.
[[nodiscard]] SceneDirections find_scene_directions(const std::vector<LineSegment>& segments,
                                                    const Camera& camera,
                                                    const SceneDirectionOptions& options,
                                                    Random& random);

}  // namespace placegraph
