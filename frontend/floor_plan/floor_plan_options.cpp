#include <placegraph/frontend/floor_plan/floor_plan_options.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {

void visit(OptionVisitor& field, SurfacePointOptions& o) {
  field("step_px", o.step_px, "distance of neighbouring points in the image", {1, 100});
  field("radius_px", o.radius_px, "half the side of the patch that determines the normal", {2, 50});
  field("max_residual", o.max_residual,
        "maximum relative rms distance of a patch's inverse depths from its plane", {1e-4, 1});
  field("max_range_m", o.max_range_m, "farther points are not used", {0.1, 1000});
}

void visit(OptionVisitor& field, DenseStereoOptions& o) {
  field("disparities", o.disparities,
        "number of disparities searched, from 0 px on; a multiple of 16", {16, 1024});
  field("window_px", o.window_px, "side of the matched blocks", {1, 21});
}

void PlaneSweepOptions::check() const {
  check_ranges(*this);
  require(min_depth_m < max_depth_m, "max_depth_m: must be above min_depth_m");
  require(window_px % 2 == 1, "window_px: must be odd");
  require(block_px % 2 == 1, "block_px: must be odd");
}

void visit(OptionVisitor& field, PlaneSweepOptions& o) {
  field("min_depth_m", o.min_depth_m, "minimum depth searched", {0.01, 1000});
  field("max_depth_m", o.max_depth_m, "maximum depth searched", {0.02, 10000});
  field("max_width_px", o.max_width_px, "width above which images are halved", {32, 10000});
  field("step_px", o.step_px, "displacement between two planes in the image that moves most",
        {0.1, 10});
  field("max_planes", o.max_planes,
        "maximum number of planes; their spacing grows if more would be needed", {8, 1000});
  field("window_px", o.window_px, "window over which brightness and contrast are normalized",
        {3, 51});
  field("noise_share", o.noise_share,
        "weakest contrast normalized to full strength [sigma of the image noise]", {0, 100});
  field("block_px", o.block_px, "window over which costs are averaged", {1, 31});
  field("path_step", o.paths.step, "cost of a depth difference by one level between neighbours",
        {0, 1000});
  field("path_jump", o.paths.jump, "cost of a larger depth difference between neighbours",
        {0, 1000});
  field("uniqueness", o.uniqueness, "relative lead that a depth must have over any other", {0, 1});
  field("distinct", o.distinct, "maximum cost of a distinct depth over its pixel's mean cost",
        {0, 1});
  field("sigma_px", o.sigma_px, "standard deviation of the position of a surface in another image",
        {0.01, 10});
}

void visit(OptionVisitor& field, SkirtingLineOptions& o) {
  field("max_range_m", o.max_range_m, "farther surfaces are not used", {0.1, 1000});
  field("step_px", o.step_px, "distance of neighbouring points in the image", {1, 100});
  field("sigma_boundary_px", o.sigma_boundary_px,
        "standard deviation of the row where floor and wall meet", {0.01, 100});
  field("skirting_m", o.skirting_m, "maximum height of skirting boards; 0: none", {0, 1});
}

void visit(OptionVisitor& field, WallFinderOptions& o) {
  field("max_sigma_m", o.max_sigma_m, "maximum standard deviation of a point that is used",
        {0.001, 10});
  field.formerly("max_turn_deg")("max_rotation_deg", o.max_rotation_deg,
                                 "maximum angle between the normals of a point and its wall",
                                 {1, 44});
  field("band_m", o.band_m, "half the thickness of a set of points that counts as one plane",
        {0.02, 1});
  field("min_height_m", o.min_height_m,
        "minimum observed height of a wall, in all its parts together", {0.1, 10});
  field("min_share", o.min_share,
        "minimum share of wall in the height that is observed or seen through", {0, 1});
  field("max_gap_m", o.max_gap_m, "longest gap within a wall", {0, 2});
  field("min_length_m", o.min_length_m, "minimum length of a wall", {0.1, 10});
  field("max_step_m", o.max_step_m, "maximum offset between pieces of one wall", {0, 1});
  field("min_top_m", o.min_top_m, "minimum height of the upper end of short pieces of wall",
        {0, 10});
}

void visit(OptionVisitor& field, DoorFinderOptions& o) {
  field("min_width_m", o.min_width_m, "minimum width of a door", {0.2, 5});
  field("max_width_m", o.max_width_m, "maximum width of a door", {0.2, 10});
  field("min_head_m", o.min_head_m, "minimum height of an opening's head above the floor",
        {0.5, 5});
  field("max_head_m", o.max_head_m, "maximum height of an opening's head above the floor",
        {0.5, 10});
  field("min_recess_m", o.min_recess_m, "minimum depth of a leaf behind its wall's surface",
        {0.005, 1});
  field("max_recess_m", o.max_recess_m, "maximum depth of a leaf behind its wall's surface",
        {0.005, 1});
}

void visit(OptionVisitor& field, RoomPartitionOptions& o) {
  field("min_area_m2", o.min_area_m2, "minimum area of a room", {0.1, 1000});
  field("neck_m", o.neck_m, "width below which free space separates rooms", {0, 5});
  field("closing_m", o.closing_m, "distance from free cells up to which unseen cells count as free",
        {0, 5});
  field("completed_share", o.completed_share,
        "share of a box between walls above which all of it is added to the room", {0, 1});
  field("walled_share", o.walled_share,
        "maximum share of walls in the border of an unseen part that is filled", {0, 1});
  field("outline_m", o.outline_m, "maximum error of the polygon that outlines a room", {0.01, 5});
}

}  // namespace placegraph
