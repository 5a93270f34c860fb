#include <placegraph/frontend/floor_plan/floor_plan_options.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {

void visit(OptionVisitor& field, SurfacePointOptions& o) {
  field("step_px", o.step_px, "distance of neighbouring points in the image", {1, 100});
  field("radius_px", o.radius_px, "half the side of the patch that determines the normal", {2, 50});
  field("max_range_m", o.max_range_m, "farther points are not used", {0.1, 1000});
  field.retired({{"max_residual", 0.01}});
}

void visit(OptionVisitor& field, DenseStereoOptions& o) {
  field("disparities", o.disparities,
        "number of disparities searched, from 0 px on; a multiple of 16", {16, 1024});
  field("window_px", o.window_px, "side of the matched blocks", {1, 21});
}

void PlaneSweepOptions::check() const {
  check_ranges(*this);
  require(min_depth_m < max_depth_m, "max_depth_m: must be above min_depth_m");
}

void visit(OptionVisitor& field, PlaneSweepOptions& o) {
  field("min_depth_m", o.min_depth_m, "minimum depth searched", {0.01, 1000});
  field("max_depth_m", o.max_depth_m, "maximum depth searched", {0.02, 10000});
  field("max_width_px", o.max_width_px, "width above which images are halved", {32, 10000});
  field("distinct", o.distinct, "maximum cost of a distinct depth over its pixel's mean cost",
        {0, 1});
  field.retired({{"path_step", 8},
                 {"path_jump", 32},
                 {"step_px", 1},
                 {"max_planes", 192},
                 {"window_px", 9},
                 {"noise_share", 2.7},
                 {"block_px", 5},
                 {"uniqueness", 0.05},
                 {"sigma_px", 0.3}});
}

void visit(OptionVisitor& field, SkirtingLineOptions& o) {
  field("max_range_m", o.max_range_m, "farther surfaces are not used", {0.1, 1000});
  field("skirting_m", o.skirting_m, "maximum height of skirting boards; 0: none", {0, 1});
  field.retired({{"step_px", 8}, {"sigma_boundary_px", 1.5}});
}

void visit(OptionVisitor& field, WallFinderOptions& o) {
  field("band_m", o.band_m, "half the thickness of a set of points that counts as one plane",
        {0.02, 1});
  field.retired({{"max_sigma_m", 0.12},
                 {"max_rotation_deg", 15},
                 {"min_height_m", 0.8},
                 {"min_share", 0.6},
                 {"max_gap_m", 0.3},
                 {"min_length_m", 0.4},
                 {"max_step_m", 0.07},
                 {"min_top_m", 2.3},
                 {"max_turn_deg", 15}});
}

void visit(OptionVisitor& field, DoorFinderOptions& o) {
  field("min_width_m", o.min_width_m, "minimum width of a door", {0.2, 5});
  field("max_width_m", o.max_width_m, "maximum width of a door", {0.2, 10});
  field("min_head_m", o.min_head_m, "minimum height of an opening's head above the floor",
        {0.5, 5});
  field("max_head_m", o.max_head_m, "maximum height of an opening's head above the floor",
        {0.5, 10});
  field.retired({{"min_recess_m", 0.025}, {"max_recess_m", 0.16}});
}

void visit(OptionVisitor& field, RoomPartitionOptions& o) {
  field("min_area_m2", o.min_area_m2, "minimum area of a room", {0.1, 1000});
  field("neck_m", o.neck_m, "width below which free space separates rooms", {0, 5});
  field.retired(
      {{"closing_m", 0.15}, {"completed_share", 0.5}, {"walled_share", 0.2}, {"outline_m", 0.08}});
}

}  // namespace placegraph
