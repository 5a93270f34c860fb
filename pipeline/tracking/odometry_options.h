#pragma once
#include <placegraph/backend/window/sliding_window_options.h>
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/frontend/relative_pose/relative_pose_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/pipeline/cues/cue_options.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Criteria for turning a frame into a keyframe.
struct KeyframeOptions {
  /// Median displacement of the tracks since the last keyframe, over the image width, above which a
  /// keyframe is created.
  double max_flow_share = 0.06;
  /// Whether to remove the camera's rotation from the displacements, so that only parallax remains.
  bool derotated = false;
  /// Minimum share of the last keyframe's landmarks that must still be inliers; with fewer, a
  /// keyframe is created.
  double min_tracked_share = 0.7;
  /// Number of frames after which a keyframe is created if the displacement is at least a tenth of
  /// max_flow_share.
  int max_interval = 20;
  void check() const;
};
void visit(OptionVisitor& field, KeyframeOptions& options);

/// Options of visual odometry, which estimates the motion over the last keyframes.
struct OdometryOptions {
  /// Motion cues, joined by commas: points, lines, plane, manhattan, direct.
  ///
  /// One of points, lines, plane and direct is required. In combination with other cues, `plane` is
  /// the ground plane, which makes the scale of a monocular camera of known height observable;
  /// alone, it is the only motion cue.
  std::string cues = "points,plane";
  PointCueOptions points;              ///< point landmarks
  MonoInitializerOptions initializer;  ///< first two keyframes of a monocular camera
  Rotation2d2dOptions pure_rotation;   ///< pure rotation of a monocular camera
  StereoMatcherOptions stereo;         ///< stereo matching of points
  RectificationOptions rectification;  ///< self-calibration of a stereo pair
  GroundPlaneScaleOptions ground;      ///< metric scale from the ground plane
  LineCueOptions lines;                ///< line landmarks, where `lines` is among the cues
  /// Rotation from Manhattan frames, where `manhattan` is among the cues.
  ManhattanCueOptions manhattan;
  PlaneLandmarkOptions planes;  ///< planes in depth images as landmarks
  /// Direct alignment, where `plane` is the only cue or `direct` is among them.
  DirectCueOptions direct;
  KeyframeOptions keyframe;  ///< criteria for a new keyframe
  /// Bundle adjustment over the last keyframes.
  SlidingWindowOptions window{.max_keyframes = 10, .relative_decrease = 1e-3};
  /// Minimum share of the tracked points that agree with the pose of a frame, which else is lost.
  double min_agreement = 0.25;
  /// SlidingWindowOptions::scale_drift (logarithm per keyframe) of a monocular camera whose scale
  /// is measured by the ground or another sensor.
  double scale_drift = 0.003;
  void check() const;
};
void visit(OptionVisitor& field, OdometryOptions& options);

}  // namespace placegraph
