#include <placegraph/pipeline/places/place_options.h>

namespace placegraph {

void PlaceOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaceOptions& o) {
  field("max_distance", o.max_distance,
        "of a keyframe from its place's anchor, as a share of the median depth", {0, 100});
  field("max_angle_deg", o.max_angle_deg, "between a keyframe and its place's anchor", {0, 180});
  field.choice("loop_kernel", o.loop_kernel.kind, robust_kernel_names(), "robust kernel of loops");
  field("loop_kernel_width", o.loop_kernel.width, "its width in standard deviations", {0.01, 1000});
  field.choice("motion_kernel", o.motion_kernel.kind, robust_kernel_names(),
               "robust kernel of motion that other sensors measured");
  field("motion_kernel_width", o.motion_kernel.width, "its width in standard deviations",
        {0.01, 1000});
  field("merge", o.merge, "places that a loop shows to be one become one");
  field("merge_sigma", o.merge_sigma,
        "standard deviation of their distance, share of the reach, above which they do not",
        {0, 100});
}

}  // namespace placegraph
