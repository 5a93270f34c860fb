#include <placegraph/frontend/scene/street_labelling_options.h>

namespace placegraph {

void StreetLabellingOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, StreetLabellingOptions& o) {
  field("step_px", o.step_px, "distance of neighbouring points in the image", {1, 100});
  field("max_range_m", o.max_range_m, "farther points are not used", {1, 1000});
  field("max_residual", o.max_residual,
        "maximum distance of a disparity from its superpixel's plane [sigma]", {0.5, 1000});
  field("moving", o.moving, "classes that move, joined by commas; they are left out of the map");
  field.group("geometry", o.geometry, "use of height and normal for the class");
  field.group("labeller", o.labeller, "labelling of superpixels");
}

void visit(OptionVisitor& field, SeenThroughOptions& o) {
  field("min_disparity_px", o.min_disparity_px,
        "minimum disparity between a point and the surface behind it", {0.1, 100});
  field("radius_px", o.radius_px, "radius within which all depths must be farther", {0, 20});
}

}  // namespace placegraph
