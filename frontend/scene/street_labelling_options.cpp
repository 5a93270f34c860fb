#include <placegraph/frontend/scene/street_labelling_options.h>

namespace placegraph {

void visit(OptionVisitor& field, UrbanGeometryOptions& o) {
  field("disparity_sigma_px", o.disparity_sigma_px,
        "minimum standard deviation of the disparity of one pixel", {0.01, 10});
  field("ground_sigma_m", o.ground_sigma_m, "unevenness of the ground at the camera", {0.001, 10});
  field("ground_sigma_rate", o.ground_sigma_rate,
        "increase of that unevenness per metre of distance [m/m]", {0, 1});
  field("outliers", o.outliers,
        "share of superpixels whose geometry does not depend on their class", {1e-6, 1});
  field("weight", o.weight, "weight of height and normal in the random field; 0: not used",
        {0, 100});
}

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
