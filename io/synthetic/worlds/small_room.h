#pragma once
#include <placegraph/io/synthetic/worlds/building_layout.h>

namespace placegraph::synthetic {

/// A furnished room of about 5 x 4 m. Desks, shelves, cabinets and boxes stand along its walls, at
/// most kFurnitureDepth_m deep; what stands on them is small and of many shapes.
struct SmallRoom {
  static constexpr double kFurnitureDepth_m = 0.75;
  Eigen::Vector2d size{5, 4};
  double height_m = 2.6;
  BuildingLayout plan{};
};

/// Adds the room and its furniture to an indoor scene.
SmallRoom build_small_room(Scene& scene, Random& random);

}  // namespace placegraph::synthetic
