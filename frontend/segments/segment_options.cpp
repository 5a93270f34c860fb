#include <placegraph/frontend/segments/segment_options.h>

namespace placegraph {

void SegmentDetectorOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SegmentDetectorOptions& o) {
  field("min_length_px", o.min_length_px, "minimum length of a segment [px]", {3, 1000});
  field("border_px", o.border_px,
        "edges along the image border within this distance are left out [px]", {0, 50});
  field.retired({{"max_angle_deg", 2}, {"max_distance_px", 1.2}, {"max_gap_px", 10}}, "merging");
  field.retired({{"reach_px", 3},
                 {"blur_px", 1},
                 {"min_gradient", 2},
                 {"min_support", 0.5},
                 {"min_sigma_px", 0.03}},
                "refinement");
}

}  // namespace placegraph
