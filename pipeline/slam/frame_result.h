#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/se3.h>

#include <optional>
#include <string>

namespace placegraph {

enum class TrackingState { kWaiting, kTracking, kLost };

/// What became of one frame.
struct FrameResult {
  FrameId frame;
  TrackingState state =
      TrackingState::kWaiting;   ///< waiting for the second view, tracking, or lost
  std::optional<SE3> T_map_cam;  ///< in the frame of `component`; nothing while unknown
  bool keyframe = false;
  bool new_place = false;
  int inliers = 0;
  int component = 0;
  int loops_accepted = 0;  ///< with this frame
  /// Why it has no pose (yet), or one that stands only if a second view confirms it; else empty.
  std::string reason;
};

}  // namespace placegraph
