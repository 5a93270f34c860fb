#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/tracking/cue_list.h>
#include <placegraph/pipeline/tracking/odometry_options.h>

namespace placegraph {

void OdometryOptions::check() const {
  check_ranges(*this);
  (void)parse_cues(cues);
}

void visit(OptionVisitor& field, OdometryOptions& o) {
  field.basic()("cues", o.cues,
                "motion cues: points, lines, plane, manhattan, direct, joined by commas");
  field.group("tracker", o.points.tracker, "tracking of points");
  field.internal().group("pose", o.points.pose, "pose of a frame from landmarks");
  field.internal().group("initializer", o.initializer, "first two keyframes of a monocular camera");
  field.internal().formerly("turn").group("pure_rotation", o.pure_rotation,
                                          "pure rotation of a monocular camera");
  field.group("stereo", o.stereo, "matching of points in the right image");
  field.group("rectification", o.rectification, "self-calibration of a stereo pair");
  field.group("ground", o.ground, "metric scale from the ground plane");
  field.group("lines", o.lines, "line landmarks, where lines is among the cues");
  field.group("manhattan", o.manhattan, "Manhattan frames, where manhattan is among the cues");
  field.group("planes", o.planes, "planes in the depth images of keyframes as landmarks");
  field.formerly("surfaces")
      .group("direct", o.direct,
             "direct alignment, where plane is the only cue or direct is among them");
  field.group("keyframe", o.keyframe, "criteria for a new keyframe");
  field.group("window", o.window, "bundle adjustment over the last keyframes");
  field("outlier_px", o.points.outlier_px,
        "reprojection error above which a landmark is removed [px]", {0.5, 100});
  field("min_unmasked_tracks", o.points.min_unmasked_tracks,
        "minimum number of points that masks from labels must leave", {0, 1e5});
  field("min_parallax_deg", o.points.min_parallax_deg,
        "minimum angle between two rays to triangulate a landmark [deg]", {0.01, 45});
  field(
      "min_agreement", o.min_agreement,
      "minimum share of the tracked points that agree with the pose; with fewer, the frame is lost",
      {0, 1});
  field.internal()("scale_drift", o.scale_drift,
                   "monocular scale drift per keyframe (logarithm) where the scale is measured",
                   {0, 1});
  field.retired({{"misfit_px", 0.4}, {"misfit_sigmas", 1.5}});
}

void KeyframeOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, KeyframeOptions& o) {
  field.basic()("max_flow_share", o.max_flow_share,
                "median displacement over the image width that triggers a keyframe", {0.001, 1});
  field("derotated", o.derotated, "remove the camera's rotation from the displacements");
  field("min_tracked_share", o.min_tracked_share,
        "minimum share of the last keyframe's landmarks still tracked", {0, 1});
  field.basic()("max_interval", o.max_interval,
                "maximum number of frames between keyframes while the camera moves", {1, 100000});
}

}  // namespace placegraph
