#pragma once
#include <placegraph/frontend/features/rgbd_errors.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/pipeline/cues/surface_labels.h>
#include <placegraph/pipeline/local_map/local_map.h>
#include <placegraph/pipeline/tracking/frame_result.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace placegraph {

/// A frame that has become a keyframe.
struct NewKeyframe {
  KeyframeId id;
  Frame frame;
  /// Labels of its surfaces, where they are labelled.
  std::shared_ptr<const SurfaceLabels> labels = nullptr;
  FrameErrors errors = FrameErrors();  ///< errors of an RGB-D camera, which its images contain
};

/// Pure rotation of a monocular camera since an earlier frame.
struct PureRotation {
  SO3 R_before_cam;
  Eigen::Matrix3d covariance;  ///< covariance of the right tangent [rad^2]
};

/// A frame that is posed after it was processed: id and T_odom_cam.
using PosedFrame = std::pair<FrameId, SE3>;

/// Result of one frame.
struct OdometryUpdate {
  TrackingState state = TrackingState::kInitializing;
  SE3 T_odom_cam;                      ///< valid if tracking, or for the first of the two views
  std::optional<KeyframeId> keyframe;  ///< reference keyframe, if tracking
  int inliers = 0;
  double agreement = 1;       ///< share of the tracked landmarks that agree with the pose
  bool contradicted = false;  ///< whether the images contradict its rotation
  Outcome outcome;            ///< outcome of tracking; the reason why it failed or restarts
  bool reference = false;     ///< during initialization: this frame is the first of the two views
  std::vector<NewKeyframe> new_keyframes;
  /// Frames before the initialization, and frames since the last keyframe, posed with landmarks
  /// that a new keyframe has improved.
  std::vector<PosedFrame> posed_again;
  std::optional<Rescale> rescale;  ///< set when the scale became known
  /// Rotation since the last keyframe (where tracking is lost) or since the first view (during
  /// initialization; if this frame replaced the first view, since the previous one).
  std::optional<PureRotation> rotation;
};

}  // namespace placegraph
