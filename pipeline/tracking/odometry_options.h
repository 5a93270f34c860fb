#pragma once
#include <placegraph/backend/window/sliding_window_options.h>
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/frontend/relative_pose/relative_pose_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/pipeline/cues/cue_options.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// When a frame becomes a keyframe.
struct KeyframeOptions {
  /// Median displacement of the tracks since the last keyframe over the image width, above which a
  /// keyframe is due.
  double max_flow_share = 0.06;
  /// Whether the camera's rotation is taken out of the displacements: what is left is parallax.
  bool derotated = false;
  /// Share of the last keyframe's landmarks that must still be inliers; with fewer a keyframe is
  /// due.
  double min_tracked_share = 0.7;
  /// Frames after which a keyframe is due if the displacement is at least a tenth of
  /// max_flow_share.
  int max_interval = 20;
  void check() const;
};
void visit(OptionVisitor& field, KeyframeOptions& options);

/// Visual odometry: the motion of the camera over the last keyframes.
struct OdometryOptions {
  /// What motion is measured by: points, lines, plane, manhattan, direct, joined by commas.
  ///
  /// One of points, lines, plane and direct is needed. Beside others, `plane` is the ground that
  /// gives a monocular camera of known height its scale; alone, it is all that motion is seen by.
  std::string cues = "points,plane";
  PointCueOptions points;              ///< point landmarks
  MonoInitializerOptions initializer;  ///< the first two keyframes of a monocular camera
  Rotation2d2dOptions turn;            ///< a monocular camera that rotates on the spot
  StereoMatcherOptions stereo;         ///< search for points in the right image
  RectificationOptions rectification;  ///< self-calibration of a stereo pair
  GroundPlaneScaleOptions ground;      ///< metric scale from the ground plane
  LineCueOptions lines;                ///< line landmarks, where `lines` is among the cues
  ManhattanCueOptions manhattan;       ///< where `manhattan` is among the cues
  PlaneLandmarkOptions planes;         ///< planes in depth images as landmarks
  DirectCueOptions surfaces;           ///< where `plane` is the only cue or `direct` is among them
  KeyframeOptions keyframe;            ///< when a frame becomes a keyframe
  /// Bundle adjustment over the last keyframes.
  SlidingWindowOptions window{.max_keyframes = 10, .relative_decrease = 1e-3};
  /// SlidingWindowOptions::scale_drift (logarithm per keyframe) of a monocular camera whose scale
  /// the ground or another sensor measures.
  double scale_drift = 0.003;
  void check() const;
};
void visit(OptionVisitor& field, OdometryOptions& options);

}  // namespace placegraph
