#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/scene/scene_map_options.h>

namespace placegraph {

void NearbyViewOptions::check() const {
  check_ranges(*this);
  require(near_m <= far_m, "far_m: must not be below near_m");
}

void visit(OptionVisitor& field, NearbyViewOptions& o) {
  field("near_m", o.near_m, "minimum distance of the nearer keyframe [m]", {0.001, 100});
  field("far_m", o.far_m, "minimum distance of the farther keyframe [m]", {0.001, 100});
  field.formerly("turn_deg")("rotation_deg", o.rotation_deg,
                             "maximum rotation between the keyframes [deg]", {0, 90});
}

void FloorPlanMapperOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, FloorPlanMapperOptions& o) {
  field.internal().group("points", o.points, "surface points of a depth image");
  field.internal().group("sweep", o.sweep, "depth from images with known poses");
  field.internal().group("views", o.views, "selection of the images for the sweep");
  field.internal().group("floor", o.floor,
                         "surfaces from a single image of a camera of known height");
  field.internal().group("orientation", o.orientation, "orientation maps of a monocular camera");
  field("min_step_m", o.min_step_m, "minimum distance from the last keyframe used [m]", {0, 10});
  field.formerly("min_turn_deg")("min_rotation_deg", o.min_rotation_deg,
                                 "rotation that admits a nearer keyframe [deg]", {0, 180});
  field("cell_m", o.cell_m, "side of the cells in which walls and rooms are found [m]", {0.01, 1});
  field("layer_m", o.layer_m, "height of the cells [m]", {0.05, 1});
  field.internal().group("walls", o.walls, "vertical surfaces up to the ceiling");
  field.internal().group("doors", o.doors, "openings and door leaves");
  field.internal().group("rooms", o.rooms, "partition of the free space into rooms");
  field.retired({{"swept_radius_px", 16}, {"swept_band_m", 0.1}});
}

void StreetMapperOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, StreetMapperOptions& o) {
  field.internal().group("stereo", o.stereo, "depth of the stereo pair");
  field.internal().formerly("sight").group("labelling", o.labelling,
                                           "labelled points of a keyframe");
  field.internal()("residuals", o.residuals,
                   "drop points that the previous or next keyframe sees through");
  field("min_step_m", o.min_step_m, "minimum distance from the last keyframe used [m]", {0, 100});
  field.formerly("min_turn_deg")("min_rotation_deg", o.min_rotation_deg,
                                 "rotation that admits a nearer keyframe [deg]", {0, 180});
  field.group("grid", o.grid, "grid in which the points are accumulated");
  field.retired({{"min_disparity_px", 2}, {"radius_px", 2}}, "seen_through");
}

}  // namespace placegraph
