#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/internal/tracking/cue_list.h>
#include <placegraph/pipeline/tracking/odometry_options.h>

namespace placegraph {

void OdometryOptions::check() const {
  check_ranges(*this);
  (void)parse_cues(cues);
}

void visit(OptionVisitor& field, OdometryOptions& o) {
  field("cues", o.cues,
        "what motion is seen by: points, lines, plane, manhattan, direct, joined by commas");
  field.group("tracker", o.points.tracker, "points followed over time");
  field.group("pose", o.points.pose, "pose of a frame from landmarks");
  field.group("initializer", o.initializer, "first two views of a single eye");
  field.group("turn", o.turn, "a single eye that turns on the spot");
  field.group("stereo", o.stereo, "matching of the right eye");
  field.group("rectification", o.rectification, "self-calibration of the two eyes");
  field.group("ground", o.ground, "metric scale from the road");
  field.group("lines", o.lines, "lines followed over time, where they are among the cues");
  field.group("manhattan", o.manhattan, "rectangular worlds, where they are among the cues");
  field.group("planes", o.planes, "planes in the depth of keyframes as landmarks of the window");
  field.group("surfaces", o.surfaces,
              "grey values of surfaces, where plane is the only cue or direct is among them");
  field.group("keyframe", o.keyframe, "when a frame becomes a keyframe");
  field.group("window", o.window, "bundle adjustment over the last keyframes");
  field("outlier_px", o.points.outlier_px, "a landmark that misses its pixel by more is dropped",
        {0.5, 100});
  field("misfit_px", o.points.misfit_px,
        "a point that misses all its pixels by this, root mean square, and by misfit_sigmas, is "
        "dropped with its track",
        {0, 100});
  field("misfit_sigmas", o.points.misfit_sigmas, "the same in standard deviations", {0.1, 100});
  field("min_unmasked_tracks", o.points.min_unmasked_tracks,
        "points without which masks from labels are not heeded", {0, 1e5});
  field("min_parallax_deg", o.points.min_parallax_deg, "to triangulate a landmark from keyframes",
        {0.01, 45});
  field("scale_drift", o.scale_drift,
        "how far the unit of a single eye wanders from keyframe to keyframe (logarithm), where the "
        "ground or another sensor measures it",
        {0, 1});
}

void KeyframeOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, KeyframeOptions& o) {
  field("max_flow_share", o.max_flow_share,
        "median displacement since the last keyframe over the image width", {0.001, 1});
  field("derotated", o.derotated,
        "whether the camera's turn is taken out of the displacements: what is left is parallax");
  field("min_tracked_share", o.min_tracked_share,
        "landmarks of the last keyframe that must still be followed", {0, 1});
  field("max_interval", o.max_interval, "frames between keyframes while the camera moves",
        {1, 100000});
}

}  // namespace placegraph
