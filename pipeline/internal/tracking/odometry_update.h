#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/pipeline/internal/cues/surface_labels.h>
#include <placegraph/pipeline/internal/local_map/local_map.h>
#include <placegraph/pipeline/slam/frame_result.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace placegraph {

/// A frame that has become a keyframe.
struct NewKeyframe {
  KeyframeId id;
  Frame frame;
  std::shared_ptr<const SurfaceLabels> labels =
      nullptr;  ///< of its surfaces, where they are labelled
};

/// A monocular camera has only rotated since an earlier frame.
struct PureRotation {
  SO3 R_before_cam;
  Eigen::Matrix3d covariance;  ///< of its right tangent [rad^2]
};

/// A frame that is posed after it was handed over: id and T_odom_cam.
using PosedFrame = std::pair<FrameId, SE3>;

/// What one frame brought.
struct OdometryUpdate {
  TrackingState state = TrackingState::kInitializing;
  SE3 T_odom_cam;                      ///< if tracking, or the first of the two views
  std::optional<KeyframeId> keyframe;  ///< reference keyframe, if tracking
  int inliers = 0;
  Outcome outcome;         ///< of tracking; why it is not, or begins anew
  bool reference = false;  ///< while waiting: this frame is the first of the two views
  std::vector<NewKeyframe> new_keyframes;
  /// Those before the initialization, and those since the last keyframe, against landmarks that a
  /// new keyframe has made better known.
  std::vector<PosedFrame> posed_again;
  std::optional<Rescale> rescale;  ///< the scale became known
  /// Since the last keyframe (where tracking is lost) or since the first view (while the second is
  /// waited for; where this frame took that one's place, since the one before it).
  std::optional<PureRotation> rotation;
};

}  // namespace placegraph
