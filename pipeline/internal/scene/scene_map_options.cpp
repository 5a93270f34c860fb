#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/scene/scene_map_options.h>

namespace placegraph {

void NearbyViewOptions::check() const {
  check_ranges(*this);
  require(near_m <= far_m, "far_m: must not be below near_m");
}

void visit(OptionVisitor& field, NearbyViewOptions& o) {
  field("near_m", o.near_m, "how far the nearer ones have moved, at least", {0.001, 100});
  field("far_m", o.far_m, "how far the farther ones have", {0.001, 100});
  field("rotation_deg", o.rotation_deg, "how much they have turned, at most", {0, 90});
}

void IndoorMapperOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, IndoorMapperOptions& o) {
  field.group("points", o.points, "surface points of a depth image");
  field.group("sweep", o.sweep, "depth from views of known motion");
  field.group("views", o.views, "that depth is swept from");
  field.group("floor", o.floor, "surfaces from one eye that has not moved");
  field.group("orientation", o.orientation, "orientation maps, for one eye");
  field("swept_radius_px", o.swept_radius_px, "points.radius_px for depth from images", {2, 50});
  field("swept_band_m", o.swept_band_m, "walls.band_m for depth from images", {0.02, 1});
  field("min_step_m", o.min_step_m, "keyframes nearer to the last one used tell nothing new",
        {0, 10});
  field("min_rotation_deg", o.min_rotation_deg, "unless they are turned by so much", {0, 180});
  field("cell_m", o.cell_m, "of the cells that walls and rooms are found from", {0.01, 1});
  field("layer_m", o.layer_m, "height of the cells", {0.05, 1});
  field.group("walls", o.walls, "upright surfaces up to the ceiling");
  field.group("doors", o.doors, "passages and leaves");
  field.group("rooms", o.rooms, "parts of the free space");
}

void UrbanMapperOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, UrbanMapperOptions& o) {
  field.group("stereo", o.stereo, "depth of two eyes");
  field.group("observation", o.observation, "what a keyframe tells");
  field("residuals", o.residuals, "points that the keyframe before or after looks through go");
  field.group("seen_through", o.seen_through, "when it does");
  field("min_step_m", o.min_step_m, "keyframes nearer to the last one that was used, and ...",
        {0, 100});
  field("min_rotation_deg", o.min_rotation_deg, "... turned by less, tell nothing new", {0, 180});
  field.group("grid", o.grid, "the cells");
}

}  // namespace placegraph
