#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/se3.h>

#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

enum class TrackingState { kWaiting, kTracking, kLost };

/// What became of one frame.
struct FrameResult {
  /// Ok if the frame has a pose that stands. Otherwise why it has none (yet), or only one that a
  /// second view must confirm.
  Outcome outcome;
  FrameId frame;
  TrackingState state =
      TrackingState::kWaiting;   ///< waiting for the second view, tracking, or lost
  std::optional<SE3> T_map_cam;  ///< in the frame of `component`; nothing while unknown
  bool keyframe = false;
  bool new_place = false;
  int inliers = 0;
  int component = 0;
  int loops_accepted = 0;  ///< with this frame
};

}  // namespace placegraph
