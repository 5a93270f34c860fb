#pragma once
#include <placegraph/frontend/vanishing/manhattan_frame.h>
#include <placegraph/frontend/vanishing/vanishing_options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Relation of a vanishing point to the Manhattan frames of its scene.
struct PointRole {
  int frame = -1, axis = -1;  ///< frame and axis that it is; -1: none
  /// Frame and axis to which a point that is not an axis is orthogonal, as all level directions are
  /// to the upright one (Atlanta worlds), and slopes of a roof to the ridge.
  int across_frame = -1, across_axis = -1;
};

/// Directions of a scene from the segments of one image.
struct SceneDirections {
  VanishingPoints vanishing;
  std::vector<PointRole> roles;        ///< role of each of vanishing.points
  std::vector<ManhattanFrame> frames;  ///< most evident first; empty if none is supported
};

/// Estimates vanishing points and Manhattan frames together.
///
/// A vanishing point that is an axis of a frame is constrained to it with the accuracy of the
/// frame's right angles; an axis with enough segments, but too few to be found without the others,
/// is a vanishing point too. Deterministic for a given `random`. Outcome and errors are those of
/// find_vanishing_points.
[[nodiscard]] SceneDirections find_scene_directions(const std::vector<LineSegment>& segments,
                                                    const Camera& camera,
                                                    const SceneDirectionOptions& options,
                                                    Random& random);

}  // namespace placegraph
