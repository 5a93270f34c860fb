#pragma once
#include <placegraph/frontend/internal/floor_plan/indoor_surfaces.h>
#include <placegraph/frontend/internal/floor_plan/room_partition.h>
#include <placegraph/frontend/internal/floor_plan/skirting_line.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/map.h>
#include <placegraph/pipeline/internal/scene/nearby_views.h>
#include <placegraph/pipeline/scene/scene_map_options.h>

#include <functional>

namespace placegraph {

/// A floor plan with walls, doors and rooms from the keyframes of a map. Depth is measured, or
/// swept from views of known motion and from the other eye; what a keyframe tells of the surfaces
/// around it is kept in its own frame; `fuse` lays all of it out with the poses of the map as it
/// stands, so that after a loop closure the plan is simply fused again.
class IndoorMapper {
 public:
  /// Throws ArgumentError for options or a calibration out of range. Sees depth where the
  /// calibration has a depth camera; else both eyes where it has a baseline, or one, and the views
  /// handed over with it. One eye that has not moved sees the floor of its orientation map
  /// `camera_height_m` below it.
  IndoorMapper(const IndoorMapperOptions& options, const Calibration& calibration);

  /// Takes the images of a keyframe, and what the same (left) eye saw from nearby; what was told of
  /// it before is replaced. Points are metric.
  void add(KeyframeId keyframe, const Frame& frame, const std::vector<SweptView>& views = {});
  void add(KeyframeSurfacePoints observation);
  const std::vector<KeyframeSurfacePoints>& observations() const { return observations_; }

  /// The plan by the poses of `map` (its first component and what is joined to it). Rooms list the
  /// places whose anchor stands in them.
  /// Outcomes: too few data (no points, or a map whose unit is not the metre), degenerate (see
  /// find_building_axes; no wall).
  [[nodiscard]] IndoorMap fuse(const Map& map) const;

 private:
  std::vector<SurfacePoint> points_of(const Frame& frame, std::vector<SweptView> views) const;
  std::vector<SurfacePoint> swept_points(const Image& image,
                                         const std::vector<SweptView>& views) const;
  std::vector<SurfacePoint> points_of_monocular(const Image& image) const;
  IndoorMapperOptions options_;
  Calibration calibration_;
  std::vector<KeyframeSurfacePoints> observations_;
};

/// Writes each room's label to its places; other labels stay.
void label_places(const IndoorMap& plan, PlaceGraph& places);

/// The plan of a map that is done: reads the frames of its keyframes (those that are far enough
/// from each other) by `frame_of`, and fuses them.
[[nodiscard]] IndoorMap map_indoors(const Map& map, const Calibration& calibration,
                                    const std::function<Frame(const Keyframe&)>& frame_of,
                                    const IndoorMapperOptions& options = {});

}  // namespace placegraph
