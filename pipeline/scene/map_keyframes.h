#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map.h>

#include <functional>
#include <optional>
#include <set>
#include <vector>

namespace placegraph {

/// Pose of a keyframe's camera in the frame of a map that is made from the keyframes; nothing if it
/// is unknown.
using KeyframePoses = std::function<std::optional<SE3>(KeyframeId keyframe)>;

/// T_map_cam of a keyframe; lengths of its points are already those of the map.
SE3 camera_pose(const Map& map, KeyframeId keyframe);

/// Keyframes of the main component of a map.
std::set<KeyframeId> connected_keyframes(const Map& map);

/// The poses of the connected keyframes.
KeyframePoses poses_of(const Map& map);
/// Pose of each keyframe when its frame had been processed, before later loops moved it.
KeyframePoses online_poses_of(const Map& map);

/// Keyframes whose distance or rotation from the previously used one is large enough, in their
/// order.
std::vector<const Keyframe*> keyframes_apart(const Map& map, double step_m, double rotation_rad);

}  // namespace placegraph
