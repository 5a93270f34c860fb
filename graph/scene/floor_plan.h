#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/so3.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A point of a surface as a keyframe observes it, in the keyframe's camera frame.
struct SurfacePoint {
  Eigen::Vector3f point = Eigen::Vector3f::Zero();  ///< position [m]
  /// Unit normal towards the camera; zero if only the point is known.
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  float sigma = 0;  ///< standard deviation of the distance along the normal, or along the ray if
                    ///< there is no normal [m]
};

/// The surface points that one keyframe observes; in its frame, so that they move with it.
struct KeyframeSurfacePoints {
  KeyframeId keyframe;               ///< the keyframe
  std::vector<SurfacePoint> points;  ///< points in its camera frame
};

/// A straight upright surface that reaches the ceiling, observed from one side.
struct PlanWall {
  Eigen::Vector2d a, b;          ///< ends, plan coordinates [m]
  Eigen::Vector2d normal;        ///< unit, towards the side from which it was observed
  double sigma_m = 0;            ///< standard deviation of its position along the normal
  double low_m = 0, high_m = 0;  ///< heights above the floor between which it was observed
  int observations = 0;          ///< surface points that it was fitted to
  std::optional<PlaceId> place;  ///< the place from which most of it was observed
  /// Distance between its ends [m].
  double length() const { return (b - a).norm(); }
};

/// A doorway in a wall, open or closed by a door leaf.
struct PlanDoor {
  Eigen::Vector2d a, b;  ///< ends of the opening, plan coordinates [m]
  double height_m = 0;   ///< height of the door head above the floor; 0: not observed
  bool closed = false;   ///< a leaf was observed in it
  /// The rooms that it connects, as positions in FloorPlan::rooms; nothing if unknown.
  std::array<std::optional<int>, 2> rooms;
};

/// A part of the free space between walls and doors.
struct PlanRoom {
  std::string label;                     ///< "corridor 1", "room 2"
  std::vector<Eigen::Vector2d> outline;  ///< closed polygon, counter-clockwise in (x, z) [m]
  std::vector<std::vector<Eigen::Vector2d>> holes;  ///< polygons within it that are not free
  double area_m2 = 0;                               ///< area of the outline without the holes
  double ceiling_m = 0;                             ///< height above the floor; 0: not observed
  bool entered = false;                             ///< whether the camera was in it
  std::vector<PlaceId> places;                      ///< places of the map inside it
};

/// A floor plan of walls, doors and rooms.
/// Plan coordinates are x and z of the plan frame: the map's frame, rotated by `R_plan_map` so that
/// its y axis points straight down.
struct FloorPlan {
  Outcome outcome;     ///< kTooFewData: no upright surfaces; kDegenerate: no vertical or no floor
  SO3 R_plan_map;      ///< maps directions of the map frame to the plan frame
  double floor_y = 0;  ///< y of the floor in the plan frame, y down [m]
  double yaw_rad = 0;  ///< direction of the walls' axes, from x towards z, modulo pi / 2
  std::vector<PlanWall> walls;  ///< one for each side of a wall that was observed
  std::vector<PlanDoor> doors;  ///< doorways between rooms
  std::vector<PlanRoom> rooms;  ///< free space, divided by walls and doors
  /// Occupancy grid of the plan, its columns and rows along the two axes of the walls.
  struct Cells {
    double size_m = 0.1;                            ///< side of a cell
    Eigen::Vector2d low = Eigen::Vector2d::Zero();  ///< corner of the grid, in the walls' axes [m]
    int columns = 0, rows = 0;                      ///< along the first and the second axis
    /// Log odds of occupancy of the cell at any height, row by row; 0: unknown.
    std::vector<float> log_odds;
  } cells;
};

}  // namespace placegraph
