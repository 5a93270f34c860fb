#include <placegraph/frontend/floor_plan/floor_plan_options.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {

void visit(OptionVisitor& field, SurfacePointOptions& o) {
  field("step_px", o.step_px, "between points", {1, 100});
  field("radius_px", o.radius_px, "of the patch whose plane gives the normal", {2, 50});
  field("max_residual", o.max_residual, "of inverse depths from their plane, relative, rms",
        {1e-4, 1});
  field("max_range_m", o.max_range_m, "farther points are not used", {0.1, 1000});
}

void visit(OptionVisitor& field, DenseStereoOptions& o) {
  field("disparities", o.disparities, "searched from 0 on, a multiple of 16", {16, 1024});
  field("window_px", o.window_px, "side of the matched blocks", {1, 21});
}

void PlaneSweepOptions::check() const {
  check_ranges(*this);
  require(min_depth_m < max_depth_m, "max_depth_m: must be above min_depth_m");
  require(window_px % 2 == 1, "window_px: must be odd");
  require(block_px % 2 == 1, "block_px: must be odd");
}

void visit(OptionVisitor& field, PlaneSweepOptions& o) {
  field("min_depth_m", o.min_depth_m, "of surfaces", {0.01, 1000});
  field("max_depth_m", o.max_depth_m, "of surfaces", {0.02, 10000});
  field("max_width_px", o.max_width_px, "wider images are halved", {32, 10000});
  field("step_px", o.step_px, "between two planes, where a view moves most", {0.1, 10});
  field("max_planes", o.max_planes, "farther apart where more would be needed", {8, 1000});
  field("window_px", o.window_px, "over which brightness and contrast are made alike", {3, 51});
  field("noise_share", o.noise_share, "contrast below so much noise counts for little", {0, 100});
  field("block_px", o.block_px, "over which costs are averaged", {1, 31});
  field("path_step", o.paths.step, "cost of neighbours one plane apart", {0, 1000});
  field("path_jump", o.paths.jump, "cost of neighbours farther apart", {0, 1000});
  field("uniqueness", o.uniqueness, "by which a depth must be better than any other", {0, 1});
  field("distinct", o.distinct, "cost of a depth that the pixel tells by itself, of its mean cost",
        {0, 1});
  field("sigma_px", o.sigma_px, "of where a surface is seen in another view", {0.01, 10});
}

void visit(OptionVisitor& field, SkirtingLineOptions& o) {
  field("max_range_m", o.max_range_m, "farther surfaces are not used", {0.1, 1000});
  field("step_px", o.step_px, "between points", {1, 100});
  field("sigma_boundary_px", o.sigma_boundary_px, "of the row where floor and wall meet",
        {0.01, 100});
  field("skirting_m", o.skirting_m, "height of skirting boards, at most; 0: none", {0, 1});
}

void visit(OptionVisitor& field, WallFinderOptions& o) {
  field("max_sigma_m", o.max_sigma_m, "of points that walls are found from", {0.001, 10});
  field("max_rotation_deg", o.max_rotation_deg, "of a point's normal from the wall's", {1, 44});
  field("band_m", o.band_m, "half width of what counts as one plane", {0.02, 1});
  field("min_height_m", o.min_height_m, "that must be seen of a wall", {0.1, 10});
  field("min_share", o.min_share, "of the looked at height that must be wall", {0, 1});
  field("max_gap_m", o.max_gap_m, "within a wall", {0, 2});
  field("min_length_m", o.min_length_m, "of a wall", {0.1, 10});
  field("max_step_m", o.max_step_m, "between pieces of one wall", {0, 1});
  field("min_top_m", o.min_top_m, "short pieces of wall reach above it", {0, 10});
}

void visit(OptionVisitor& field, DoorFinderOptions& o) {
  field("min_width_m", o.min_width_m, "of a door", {0.2, 5});
  field("max_width_m", o.max_width_m, "of a door", {0.2, 10});
  field("min_head_m", o.min_head_m, "of an opening's head above the floor", {0.5, 5});
  field("max_head_m", o.max_head_m, "of an opening's head above the floor", {0.5, 10});
  field("min_recess_m", o.min_recess_m, "of a leaf behind its wall's surface", {0.005, 1});
  field("max_recess_m", o.max_recess_m, "of a leaf behind its wall's surface", {0.005, 1});
}

void visit(OptionVisitor& field, RoomPartitionOptions& o) {
  field("min_area_m2", o.min_area_m2, "of a room", {0.1, 1000});
  field("neck_m", o.neck_m, "free space narrower than this parts rooms", {0, 5});
  field("closing_m", o.closing_m, "unseen cells so near to free ones are free", {0, 5});
  field("completed_share", o.completed_share,
        "of a box between walls that is seen free: then all of it is", {0, 1});
  field("walled_share", o.walled_share,
        "of the border of an unseen part of a room: with more walls it is not the room's", {0, 1});
  field("outline_m", o.outline_m, "tolerance of a room's outline", {0.01, 5});
}

}  // namespace placegraph
