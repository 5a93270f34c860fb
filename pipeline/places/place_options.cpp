#include <placegraph/pipeline/places/place_options.h>

namespace placegraph {

void PlaceOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaceOptions& o) {
  field.basic()("max_distance", o.max_distance,
                "maximum distance of a keyframe from its place's anchor, share of the median depth",
                {0, 100});
  field.basic()("max_angle_deg", o.max_angle_deg,
                "maximum rotation between a keyframe and its place's anchor [deg]", {0, 180});
  field.choice("loop_kernel", o.loop_kernel.kind, robust_kernel_names(), "robust kernel of loops");
  field("loop_kernel_width", o.loop_kernel.width, "width of the kernel in standard deviations",
        {0.01, 1000});
  field.choice("motion_kernel", o.motion_kernel.kind, robust_kernel_names(),
               "robust kernel of motion measured by other sensors");
  field("motion_kernel_width", o.motion_kernel.width, "width of the kernel in standard deviations",
        {0.01, 1000});
  field.basic()("merge", o.merge, "merge places that a loop shows to be the same");
  field("merge_sigma", o.merge_sigma,
        "maximum standard deviation of the relative position, as a share of the reach", {0, 100});
}

}  // namespace placegraph
