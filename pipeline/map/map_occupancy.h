#pragma once
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/scene/floor_plan.h>
#include <placegraph/io/exports/occupancy_file.h>
#include <placegraph/pipeline/map/map_geometry.h>

namespace placegraph {

/// Settings of occupancy_of.
struct MapOccupancyOptions {
  double cell_m = 0.05;      ///< side of a cell
  double below_m = 0.5;      ///< the band of heights that is examined, below the cameras
  double above_m = 0.5;      ///< the same above them
  double range_m = 20;       ///< longest part of a ray that is used
  double radius_m = 0.2;     ///< what is free around the path of the camera
  double max_sigma_m = 0.5;  ///< landmarks with a larger standard deviation are not used
};

/// An occupancy grid of one component of a map, and why there is none.
struct MapOccupancy {
  Outcome outcome;     ///< outcome, see occupancy_of
  OccupancyGrid grid;  ///< the grid; empty if there is none
};

/// The occupancy grid of the heights near the cameras.
///
/// Up is the mean of the cameras' up directions. A ray from a keyframe to a landmark makes cells
/// free where it is within the band of heights, up to two standard deviations before the landmark;
/// a landmark within the band makes its cell occupied; the path of the camera is free. Evidence is
/// added as log odds. With a floor plan (may be nullptr) up is the plan's, and its walls are
/// occupied. Throws ArgumentError as Map::components, and for a grid of more than 10^8
/// cells. kTooFewData: the map is not metric, or the component has no pose.
[[nodiscard]] MapOccupancy occupancy_of(const Map& map, int component,
                                        const MapOccupancyOptions& options = {},
                                        const FloorPlan* plan = nullptr);

}  // namespace placegraph
