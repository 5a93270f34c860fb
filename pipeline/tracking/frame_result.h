#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/se3.h>

#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

/// State of tracking after a frame.
enum class TrackingState {
  kInitializing,  ///< no pose yet: the map has not begun, or its metric scale is not yet known
  kTracking,      ///< the frame has a pose
  kLost           ///< no pose, although a map exists
};

/// Result of processing one frame.
struct FrameResult {
  /// Ok if the frame has a pose that needs no confirmation. Otherwise the reason why it has no pose
  /// (yet), or only one that a second view must confirm.
  Outcome outcome;
  FrameId frame;  ///< id of the processed frame
  /// `kTracking` if and only if T_map_cam has a value.
  TrackingState state = TrackingState::kInitializing;
  /// Pose of the (left) camera in the coordinate frame of `component`, as estimated when the frame
  /// had been processed; nothing while unknown.
  std::optional<SE3> T_map_cam;
  bool keyframe = false;   ///< whether keyframes were added to the map with this frame
  bool new_place = false;  ///< whether one of these keyframes founded a place
  int inliers = 0;  ///< number of landmarks (or pixels of aligned planes) that agree with the pose
  /// Share of the tracked landmarks that agree with the pose, in [0, 1], times n / (n + m) for n
  /// inliers where m are needed at least. Nothing for a pose that was not found by tracking.
  std::optional<double> confidence;
  int component = 0;       ///< component in which T_map_cam is expressed; 0 is the first
  int loops_accepted = 0;  ///< number of loop closures that were accepted with this frame
};

}  // namespace placegraph
