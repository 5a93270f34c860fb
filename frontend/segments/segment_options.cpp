#include <placegraph/frontend/segments/segment_options.h>

namespace placegraph {

void visit(OptionVisitor& field, SegmentMergingOptions& o) {
  field("max_angle_deg", o.max_angle_deg, "maximum angle between pieces of one edge [deg]",
        {0, 20});
  field("max_distance_px", o.max_distance_px,
        "maximum distance of the pieces' ends from the common line [px]", {0, 20});
  field("max_gap_px", o.max_gap_px, "maximum gap between pieces, along the line [px]", {0, 1000});
}

void visit(OptionVisitor& field, EdgeRefinementOptions& o) {
  field("reach_px", o.reach_px, "search distance for the edge on both sides of the segment [px]",
        {1, 20});
  field("blur_px", o.blur_px, "standard deviation of the blur before the gradient is taken [px]",
        {0.3, 5});
  field("min_gradient", o.min_gradient,
        "minimum gradient of a point of the edge [grey levels / px]", {0, 255});
  field("min_support", o.min_support,
        "minimum share of the segment's samples at which the edge is found", {0, 1});
  field("min_sigma_px", o.min_sigma_px,
        "minimum standard deviation of a sample across the edge [px]", {1e-4, 5});
}

void SegmentDetectorOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SegmentDetectorOptions& o) {
  field("min_length_px", o.min_length_px, "minimum length of a segment [px]", {3, 1000});
  field("border_px", o.border_px,
        "edges along the image border within this distance are left out [px]", {0, 50});
  field.group("merging", o.merging, "joining of pieces of one edge");
  field.group("refinement", o.refinement, "sub-pixel fit to the gradient");
}

void visit(OptionVisitor& field, SegmentFlowOptions& o) {
  field("strip_px", o.strip_px, "half the width of the strip [px]", {3, 30});
  field("iterations", o.iterations, "Gauss-Newton iterations on each level", {1, 50});
  field("robust_grey", o.robust_grey, "width of the Huber kernel on residuals [grey levels of 255]",
        {1, 255});
  field.formerly("max_turn_deg")("max_rotation_deg", o.max_rotation_deg,
                                 "maximum rotation from the predicted direction [deg]", {1, 60});
}

}  // namespace placegraph
