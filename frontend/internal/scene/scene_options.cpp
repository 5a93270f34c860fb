#include <placegraph/frontend/scene/scene_options.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {

void SceneMaskOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SceneMaskOptions& o) {
  field("sky", o.sky, "nothing is looked for in the sky");
  field("moving", o.moving, "nor on what may move: cars, people, bicycles");
  field("ground", o.ground, "the road is measured only where it is ground");
  field("min_sky", o.min_sky, "probability from which it is sky", {0, 1});
  field("min_moving", o.min_moving, "probability from which it may move", {0, 1});
  field("min_ground", o.min_ground, "probability from which it is ground", {0, 1});
  field("margin_px", o.margin_px, "about what may move, as its contour moves too", {0, 50});
  field("min_share", o.min_share, "of the picture that must be left, otherwise no mask is used",
        {0, 1});
}

void EnvironmentFilterOptions::check() const {
  check_ranges(*this);
  require(leave < enter, "leave: must be below enter");
}

void visit(OptionVisitor& field, EnvironmentFilterOptions& o) {
  field("stay", o.stay, "probability that the next view is of the same kind", {0.2, 1});
  field("evidence", o.evidence, "power of a view's probabilities: neighbours err alike", {0, 1});
  field("enter", o.enter, "probability from which a kind is taken", {0, 1});
  field("leave", o.leave, "probability below which it is given up", {0, 1});
  field("min_views", o.min_views, "before anything is said", {1, 1000});
}

void visit(OptionVisitor& field, OrientationMapOptions& o) {
  field("cell_px", o.cell_px, "of the raster that lines are swept over", {1, 64});
  field("max_sweep", o.max_sweep, "way from an edge that it still speaks for, in image widths",
        {0.01, 10});
  field("min_margin", o.min_margin, "the best orientation against the second", {1, 100});
  field("min_confidence", o.min_confidence, "pixels below it have no orientation", {0, 1});
  field("smoothing_cells", o.smoothing_cells, "radius of the vote among neighbours; 0: none",
        {0, 50});
}

void StreetLabellingOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, StreetLabellingOptions& o) {
  field("step_px", o.step_px, "between points", {1, 100});
  field("max_range_m", o.max_range_m, "farther points are not used", {1, 1000});
  field("max_residual", o.max_residual,
        "standard deviations of a disparity from its superpixel's plane", {0.5, 1000});
  field("moving", o.moving, "classes that are no part of the map, joined by commas");
  field.group("geometry", o.geometry, "what height and normal say of the class");
  field.group("labeller", o.labeller, "the labels of superpixels");
}

void visit(OptionVisitor& field, SeenThroughOptions& o) {
  field("min_disparity_px", o.min_disparity_px, "by which what stands behind must be farther",
        {0.1, 100});
  field("radius_px", o.radius_px, "all around must be so", {0, 20});
}

void visit(OptionVisitor& field, UrbanGeometryOptions& o) {
  field("disparity_sigma_px", o.disparity_sigma_px, "of one pixel", {0.01, 10});
  field("ground_sigma_m", o.ground_sigma_m, "how even the ground is near by", {0.001, 10});
  field("ground_sigma_rate", o.ground_sigma_rate, "more of it by the metre of distance", {0, 1});
  field("outliers", o.outliers, "share of superpixels whose place says nothing", {1e-6, 1});
  field("weight", o.weight, "of height and normal in the random field; 0: none", {0, 100});
}

void LabellerOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LabellerOptions& o) {
  field("context", o.context, "labels around count");
  field("field", o.field, "neighbours that look alike tend to one label");
  field("relations", o.relations, "which classes lie above and beside which counts");
  field("rounds", o.rounds, "of the labels around", {1, 5});
}

}  // namespace placegraph
