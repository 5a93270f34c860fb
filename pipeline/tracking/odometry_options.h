#pragma once
#include <placegraph/backend/window/sliding_window_options.h>
#include <placegraph/frontend/features/rectification.h>
#include <placegraph/frontend/features/stereo_matcher.h>
#include <placegraph/frontend/relative_pose/mono_initializer.h>
#include <placegraph/frontend/relative_pose/rotation_2d2d.h>
#include <placegraph/pipeline/cues/surface_cue.h>
#include <placegraph/pipeline/lines/line_cue.h>
#include <placegraph/pipeline/cues/manhattan_cue.h>
#include <placegraph/pipeline/cues/plane_cue.h>
#include <placegraph/pipeline/cues/point_cue.h>
#include <placegraph/pipeline/tracking/cue_list.h>
#include <placegraph/pipeline/tracking/keyframe_selector.h>
#include <placegraph/pipeline/scale/ground_plane_scale.h>

#include <string>

namespace placegraph {

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

/// Whether lengths are metric from the first frame on: a stereo or depth camera measures them, as
/// does a surface at a known distance if surfaces are the only cue.
bool metric_from_start(const Cues& cues, const Calibration& calibration);

}  // namespace placegraph
