#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/se3.h>

#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

/// Whether a frame could be posed.
enum class TrackingState {
  kInitializing,  ///< no pose yet: the map has not begun, or waits for its metric scale
  kTracking,      ///< posed
  kLost           ///< no pose, though there is a map
};

/// What became of one frame.
struct FrameResult {
  /// Ok if the frame has a pose that needs no confirmation. Otherwise why it has none (yet), or
  /// only one that a second view must confirm.
  Outcome outcome;
  FrameId frame;                                       ///< the id of the frame that was processed
  TrackingState state = TrackingState::kInitializing;  ///< kTracking exactly if T_map_cam is there
  /// Pose of the (left) camera in the coordinate frame of `component`, as known when the frame was
  /// done; nothing while unknown.
  std::optional<SE3> T_map_cam;
  bool keyframe = false;   ///< whether keyframes were added to the map with this frame
  bool new_place = false;  ///< whether one of them founded a place
  int inliers = 0;         ///< landmarks (or pixels of aligned planes) that agree with the pose
  int component = 0;       ///< the sub-map that T_map_cam is in; 0 is the first
  int loops_accepted = 0;  ///< loop closures that were accepted with this frame
};

}  // namespace placegraph
