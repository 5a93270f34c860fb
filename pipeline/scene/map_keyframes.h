#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map.h>

#include <set>
#include <vector>

namespace placegraph {

/// T_map_cam of a keyframe; lengths of its points are already those of the map.
SE3 camera_pose(const Map& map, KeyframeId keyframe);

/// Keyframes of the main component of a map.
std::set<KeyframeId> connected_keyframes(const Map& map);

/// Keyframes that are far enough from the one used before, in their order.
///
/// Their distance is at least `step_m`, or their rotation at least `rotation_rad`.
std::vector<const Keyframe*> keyframes_apart(const Map& map, double step_m, double rotation_rad);

}  // namespace placegraph
