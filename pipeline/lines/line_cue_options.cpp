#include <placegraph/pipeline/lines/line_cue_options.h>

namespace placegraph {

void LineCueOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LineCueOptions& o) {
  field.group("tracker", o.tracker, "lines followed over time");
  field.group("stereo", o.stereo, "lines in the right eye");
  field.group("triangulation", o.triangulation, "when a line's place is known");
  field.group("pose", o.pose, "pose of a frame from lines");
  field.group("start", o.start, "first views of a single eye without points");
  field.group("floor", o.floor, "metric scale from lines on the floor, without points");
  field("sigma_floor_px", o.sigma_floor_px, "no line is placed better across", {0.01, 10});
  field("alike_sightings", o.alike_sightings,
        "sightings of one edge in the window that are worth one independent one", {1, 1000});
  field("min_turn_steered_deg", o.min_turn_steered_deg,
        "triangulation.min_turn_deg where directions show the rotation", {0.01, 45});
  field("stay_frames", o.stay_frames,
        "an edge that the motion takes out of the image before is begun last", {0, 100});
  field("outlier_px", o.outlier_px, "a line that is missed by more is dropped", {0.5, 100});
}

}  // namespace placegraph
