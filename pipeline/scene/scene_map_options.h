#pragma once
#include <placegraph/frontend/floor_plan/floor_plan_options.h>
#include <placegraph/frontend/scene/scene_options.h>
#include <placegraph/frontend/scene/street_labelling_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/scene/street_map.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Selection of the neighbouring keyframes from which plane sweep computes depth.
///
/// On either side in time, within ten keyframes: the first that has moved by near_m, and the first
/// that has moved by far_m.
struct NearbyViewOptions {
  double near_m = 0.2;  ///< minimum distance of the nearer keyframe
  /// Minimum distance of the farther one; none is farther than twice this value.
  double far_m = 0.5;
  double rotation_deg = 20;  ///< maximum rotation between the keyframes
  void check() const;
};
void visit(OptionVisitor& field, NearbyViewOptions& options);

/// Options for making a floor plan with walls, doors and rooms from a finished metric map.
struct FloorPlanMapperOptions {
  SurfacePointOptions points;  ///< surface points of a depth image
  PlaneSweepOptions sweep;     ///< depth from images with known poses
  /// Images used for the sweep, in addition to the right one of a stereo pair.
  NearbyViewOptions views;
  SkirtingLineOptions floor;          ///< surfaces from a single image of a camera of known height
  OrientationMapOptions orientation;  ///< orientations of surfaces from a single image
  /// Minimum distance [m] from the last keyframe used; a nearer keyframe is used only if it is
  /// rotated by min_rotation_deg.
  double min_step_m = 0.15;
  double min_rotation_deg = 5;  ///< see min_step_m
  double cell_m = 0.05;         ///< side of the cells in which walls and rooms are found
  double layer_m = 0.2;         ///< height of the cells
  WallFinderOptions walls;      ///< vertical surfaces up to the ceiling
  DoorFinderOptions doors;      ///< openings and door leaves
  RoomPartitionOptions rooms;   ///< partition of the free space into rooms
  void check() const;
};
void visit(OptionVisitor& field, FloorPlanMapperOptions& options);

/// Options for making a semantic street map from the stereo keyframes of a metric map.
struct StreetMapperOptions {
  DenseStereoOptions stereo{128, 9};  ///< depth of the stereo pair
  StreetLabellingOptions labelling;   ///< labelled points of a keyframe
  /// Drop points that the previous or the next keyframe sees through: these points have moved.
  bool residuals = true;
  /// Minimum distance [m] from the last keyframe used; a nearer keyframe is used only if it is
  /// rotated by min_rotation_deg.
  double min_step_m = 1;
  double min_rotation_deg = 5;  ///< see min_step_m
  StreetGridOptions grid;       ///< grid in which the points are accumulated
  void check() const;
};
void visit(OptionVisitor& field, StreetMapperOptions& options);

}  // namespace placegraph
