#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map.h>

#include <functional>
#include <optional>
#include <set>
#include <vector>

namespace placegraph {

/// Where a keyframe's camera stands, in whatever frame a map that is made from them shall be in;
/// nothing where that is not known.
using KeyframePoses = std::function<std::optional<SE3>(KeyframeId keyframe)>;

/// T_map_cam of a keyframe; lengths of its points are those of the map already.
SE3 camera_pose(const Map& map, KeyframeId keyframe);

/// Keyframes of the first component of a map and of what is joined to it.
std::set<KeyframeId> connected_keyframes(const Map& map);

/// The poses of the connected keyframes.
KeyframePoses poses_of(const Map& map);
/// As each keyframe stood when its frame had been processed, before later loops moved it.
KeyframePoses online_poses_of(const Map& map);

/// Keyframes that are far enough from the one used before, or turned enough, in their order.
std::vector<const Keyframe*> keyframes_apart(const Map& map, double step_m, double rotation_rad);

}  // namespace placegraph
