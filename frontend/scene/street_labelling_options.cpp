#include <placegraph/frontend/scene/street_labelling_options.h>

namespace placegraph {

void visit(OptionVisitor& field, StreetGeometryOptions& o) {
  field("outliers", o.outliers,
        "share of superpixels whose geometry does not depend on their class", {1e-6, 1});
  field("weight", o.weight, "weight of height and normal in the random field; 0: not used",
        {0, 100});
  field.retired(
      {{"disparity_sigma_px", 0.25}, {"ground_sigma_m", 0.03}, {"ground_sigma_rate", 0.004}});
}

void StreetLabellingOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, StreetLabellingOptions& o) {
  field("step_px", o.step_px, "distance of neighbouring points in the image", {1, 100});
  field("max_range_m", o.max_range_m, "farther points are not used", {1, 1000});
  field("moving", o.moving, "classes that move, joined by commas; they are left out of the map");
  field.group("geometry", o.geometry, "use of height and normal for the class");
  field.group("labeller", o.labeller, "labelling of superpixels");
  field.retired({{"max_residual", 3}});
}

}  // namespace placegraph
