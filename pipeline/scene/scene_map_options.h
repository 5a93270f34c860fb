#pragma once
#include <placegraph/frontend/floor_plan/floor_plan_options.h>
#include <placegraph/frontend/scene/scene_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/scene/semantic_map.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Which neighbouring keyframes give depth to a keyframe by plane sweep.
///
/// On either side in time, within ten keyframes: the first that has moved by near_m, and the first
/// that has moved by far_m.
struct NearbyViewOptions {
  double near_m = 0.2;  ///< least distance of the nearer keyframe
  double far_m = 0.5;   ///< least distance of the farther one; none is farther than twice as much
  double rotation_deg = 20;  ///< largest rotation between the keyframes
  void check() const;
};
void visit(OptionVisitor& field, NearbyViewOptions& options);

/// How a floor plan with walls, doors and rooms is made of a finished metric map.
struct IndoorMapperOptions {
  SurfacePointOptions points;  ///< surface points of a depth image
  PlaneSweepOptions sweep;     ///< depth from images of known poses
  NearbyViewOptions views;     ///< the images to sweep over, beside the right one of a stereo pair
  SkirtingLineOptions floor;   ///< surfaces in a single image of a camera of known height
  OrientationMapOptions orientation;  ///< orientations of surfaces in a single image
  int swept_radius_px = 16;           ///< replaces points.radius_px for depth from images
  double swept_band_m = 0.1;          ///< replaces walls.band_m for depth from images
  /// A keyframe nearer than min_step_m to the last one used is used only if it is rotated by
  /// min_rotation_deg.
  double min_step_m = 0.15;
  double min_rotation_deg = 5;  ///< see min_step_m
  double cell_m = 0.05;         ///< side of the cells that walls and rooms are found from
  double layer_m = 0.2;         ///< height of the cells
  WallFinderOptions walls;      ///< upright surfaces up to the ceiling
  DoorFinderOptions doors;      ///< openings and door leaves
  RoomPartitionOptions rooms;   ///< parts of the free space
  void check() const;
};
void visit(OptionVisitor& field, IndoorMapperOptions& options);

/// How a semantic map of a street is made of the stereo keyframes of a finished metric map.
struct UrbanMapperOptions {
  DenseStereoOptions stereo{128, 9};   ///< depth of the stereo pair
  StreetLabellingOptions observation;  ///< labelled points of a keyframe
  /// Drop points that the keyframe before or after sees through: they have moved.
  bool residuals = true;
  SeenThroughOptions seen_through;  ///< when a point counts as seen through
  /// A keyframe nearer than min_step_m to the last one used is used only if it is rotated by
  /// min_rotation_deg.
  double min_step_m = 1;
  double min_rotation_deg = 5;  ///< see min_step_m
  SemanticGridOptions grid;     ///< cells that the points are gathered in
  void check() const;
};
void visit(OptionVisitor& field, UrbanMapperOptions& options);

}  // namespace placegraph
