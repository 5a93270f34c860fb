#pragma once
#include <placegraph/frontend/floor_plan/plan_surfaces.h>
#include <placegraph/frontend/floor_plan/room_partition.h>
#include <placegraph/frontend/floor_plan/skirting_line.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/map.h>
#include <placegraph/pipeline/scene/nearby_views.h>
#include <placegraph/pipeline/scene/scene_map_options.h>

#include <vector>

namespace placegraph {

/// Makes a floor plan with walls, doors and rooms from the keyframes of a map. Depth is measured,
/// or computed by plane sweep from images of known motion and from the second camera. The surface
/// points of a keyframe are stored in its own frame; `fuse` transforms all of them with the current
/// poses of the map, so that after a loop closure the plan is recomputed by fusing again.
class FloorPlanMapper {
 public:
  /// Throws ArgumentError for options or a calibration out of range. Depth comes from the depth
  /// camera if the calibration has one; otherwise from the stereo pair if it has a baseline, or
  /// from one camera, and from the views given with a keyframe. A monocular camera that has not
  /// moved observes the floor with its orientation map, at `camera_height_m` below it.
  FloorPlanMapper(const FloorPlanMapperOptions& options, const Calibration& calibration);

  /// Adds the images of a keyframe, and views of the same (left) camera from nearby; replaces
  /// earlier data of this keyframe. Points are metric.
  void add(KeyframeId keyframe, const Frame& frame, const std::vector<SweptView>& views = {});
  void add(KeyframeSurfacePoints observation);
  const std::vector<KeyframeSurfacePoints>& observations() const { return observations_; }

  /// Computes the plan with the poses of `map` (its first component and those joined to it). Rooms
  /// list the places whose anchor is in them.
  /// Outcomes: too few data (no points, or a map that is not metric), degenerate (see
  /// find_building_axes; no wall).
  [[nodiscard]] FloorPlan fuse(const Map& map) const;

 private:
  std::vector<SurfacePoint> points_of(const Frame& frame, std::vector<SweptView> views) const;
  std::vector<SurfacePoint> swept_points(const Image& image,
                                         const std::vector<SweptView>& views) const;
  std::vector<SurfacePoint> points_of_monocular(const Image& image) const;
  FloorPlanMapperOptions options_;
  Calibration calibration_;
  std::vector<KeyframeSurfacePoints> observations_;
};

}  // namespace placegraph
