#include <placegraph/frontend/scene/scene_options.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {

void SceneMaskOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SceneMaskOptions& o) {
  field("sky", o.sky, "mask the sky");
  field("moving", o.moving, "mask objects that may move: cars, people, bicycles");
  field("ground", o.ground, "align the ground plane only on ground pixels");
  field("min_sky", o.min_sky, "minimum probability of sky", {0, 1});
  field("min_moving", o.min_moving, "minimum probability of an object that may move", {0, 1});
  field("min_ground", o.min_ground, "minimum probability of ground", {0, 1});
  field("margin_px", o.margin_px, "margin around objects that may move, as their contours move too",
        {0, 50});
  field("min_share", o.min_share,
        "minimum share of the image that a mask leaves; otherwise it is not used", {0, 1});
}

void EnvironmentFilterOptions::check() const {
  check_ranges(*this);
  require(leave < enter, "leave: must be below enter");
}

void visit(OptionVisitor& field, EnvironmentFilterOptions& o) {
  field("enter", o.enter, "probability from which a kind is accepted", {0, 1});
  field("leave", o.leave, "probability below which the accepted kind is dropped", {0, 1});
  field.retired({{"stay", 0.97}, {"evidence", 0.5}, {"min_views", 3}});
}

void visit(OptionVisitor& field, OrientationMapOptions& o) {
  field("cell_px", o.cell_px, "side of the cells of the raster that lines are swept over", {1, 64});
  field("min_margin", o.min_margin,
        "minimum ratio of the support of the best to the second orientation", {1, 100});
  field("min_confidence", o.min_confidence, "pixels of less confidence get no orientation", {0, 1});
  field.retired({{"max_sweep", 0.6}, {"smoothing_cells", 2}});
}

}  // namespace placegraph
