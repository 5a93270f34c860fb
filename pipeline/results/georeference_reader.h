#pragma once
#include <placegraph/graph/geometry/geodesy.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/map.h>

#include <functional>
#include <optional>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Position of a map on the earth, as written by `placegraph map georeference`.
struct Georeference {
  GeodeticPosition origin;  ///< of the frame enu
  Trajectory trajectory;    ///< T_enu_cam of the frames that have a pose, by ascending stamps
  /// Pose T_enu_cam of a keyframe; nothing if its frame has none.
  std::function<std::optional<SE3>(KeyframeId)> T_enu_keyframe;

  /// The pose T_enu_cam of the frame with this stamp; nothing if it has none.
  std::optional<SE3> at(std::int64_t stamp_ns) const;
};

/// Reads georeference.json and trajectory_enu.tum in a folder. Throws FileError.
Georeference read_georeference(const std::string& folder, const Map& map);

}  // namespace placegraph
