#pragma once
#include <placegraph/io/synthetic/worlds/building_layout.h>
#include <placegraph/io/synthetic/worlds/tours.h>

namespace placegraph::synthetic {

/// The motion of a camera that is carried through a building.
struct IndoorWalk {
  std::vector<Eigen::Vector2d> corners;  ///< (x, z); the first leg must run along +z
  double rotation_window_m = 1.0;        ///< path length over which corners are rounded [m]
  double speed_mps = 1.0;
  double camera_height_m = 1.4;
};

/// The camera of all indoor worlds: 640 x 480, f = 525 px.
Camera indoor_camera();
constexpr double kIndoorBaseline_m = 0.1;

/// Fills time, poses, camera and floor plan of `tour`: 10 Hz, 640 x 480, swaying like a walker. The
/// first pose has the scene's axes, so that the plan and poses.txt differ by a shift only.
void walk_through(const BuildingLayout& plan, const IndoorWalk& walk, std::uint32_t seed,
                  Tour& tour);

}  // namespace placegraph::synthetic
