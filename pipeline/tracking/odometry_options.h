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
  double max_flow_share = 0.06;  ///< median track displacement since the last one / image width
  /// Whether the camera's turn is taken out of the displacements: what is left is parallax.
  bool derotated = false;
  double min_tracked_share = 0.7;  ///< of the last keyframe's landmarks still followed
  int max_interval = 20;           ///< frames, if the camera moves at all
  void check() const;
};
void visit(OptionVisitor& field, KeyframeOptions& options);

struct OdometryOptions {
  std::string cues = "points,plane";  ///< see parse_cues
  PointCueOptions points;
  MonoInitializerOptions initializer;
  Rotation2d2dOptions turn;
  StereoMatcherOptions stereo;
  RectificationOptions rectification;
  GroundScaleOptions ground;
  LineCueOptions lines;
  ManhattanCueOptions manhattan;
  PlaneLandmarkOptions planes;
  SurfaceCueOptions surfaces;
  KeyframeOptions keyframe;
  SlidingWindowOptions window{.max_keyframes = 10, .relative_decrease = 1e-3};
  /// SlidingWindowOptions::scale_drift of a single eye whose unit the ground or another sensor
  /// measures.
  double scale_drift = 0.003;
  void check() const;
};
void visit(OptionVisitor& field, OdometryOptions& options);

}  // namespace placegraph
