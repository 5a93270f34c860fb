#include <placegraph/frontend/labels/label_options.h>

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

void LabellerOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LabellerOptions& o) {
  field("context", o.context,
        "whether a second forest uses the labels of neighbouring superpixels");
  field("field", o.field, "whether a random field favours equal labels for similar neighbours");
  field("relations", o.relations,
        "whether the field uses a table of the classes above and beside each class");
  field("rounds", o.rounds, "number of applications of the second forest", {1, 5});
}

}  // namespace placegraph
