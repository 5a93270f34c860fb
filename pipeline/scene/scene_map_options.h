#pragma once
#include <placegraph/frontend/floor_plan/floor_plan_options.h>
#include <placegraph/frontend/scene/scene_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/scene/semantic_map.h>

namespace [[gnu::visibility("default")]] placegraph {

struct NearbyViewOptions {
  double near_m = 0.2;   ///< how far the nearer views have moved, at least, and ...
  double far_m = 0.5;    ///< ... the farther ones; none has by twice as much
  double turn_deg = 20;  ///< how much they have turned, at most
  void check() const;
};
void visit(OptionVisitor& field, NearbyViewOptions& options);

struct IndoorMapperOptions {
  SurfacePointOptions points;
  PlaneSweepOptions sweep;
  NearbyViewOptions views;  ///< that depth is swept from, beside the right eye's
  FloorSightOptions floor;
  OrientationMapOptions orientation;
  int swept_radius_px = 16;   ///< as points.radius_px, of depth from images, and ...
  double swept_band_m = 0.1;  ///< ... walls.band_m
  double min_step_m = 0.15;   ///< keyframes nearer to the last one that was used, and ...
  double min_turn_deg = 5;    ///< ... turned by less, tell nothing new
  double cell_m = 0.05;       ///< of the cells that walls and rooms are found from
  double layer_m = 0.2;       ///< their height
  WallFinderOptions walls;
  DoorFinderOptions doors;
  RoomPartitionOptions rooms;
  void check() const;
};
void visit(OptionVisitor& field, IndoorMapperOptions& options);

struct UrbanMapperOptions {
  DenseStereoOptions stereo{128, 9};
  UrbanSightOptions sight;
  bool residuals = true;  ///< points that the keyframe before or after looks through are dropped
  SeenThroughOptions seen_through;
  double min_step_m = 1;    ///< keyframes nearer to the last one that was used, and ...
  double min_turn_deg = 5;  ///< ... turned by less, tell nothing new
  SemanticGridOptions grid;
  void check() const;
};
void visit(OptionVisitor& field, UrbanMapperOptions& options);

}  // namespace placegraph
