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

/// A point of a surface as a keyframe sees it, in the keyframe's camera frame.
struct SurfacePoint {
  Eigen::Vector3f point = Eigen::Vector3f::Zero();
  /// Unit, towards the camera; zero where only the point is known.
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  float sigma = 0;  ///< of the distance along the normal, or along the ray where there is none
};

/// What one keyframe tells of the surfaces around it, and where it hangs. It moves with its place.
struct SurfaceSight {
  KeyframeId keyframe;
  std::vector<SurfacePoint> points;
};

/// A straight upright surface that reaches the ceiling, as it was seen from one side.
struct IndoorWall {
  Eigen::Vector2d a, b;          ///< ends, plan coordinates [m]
  Eigen::Vector2d normal;        ///< unit, towards the side it was seen from
  double sigma_m = 0;            ///< of its position along the normal
  double low_m = 0, high_m = 0;  ///< heights above the floor between which it was seen
  int sights = 0;                ///< surface points that it was fitted to
  std::optional<PlaceId> place;  ///< the place that saw most of it
  double length() const { return (b - a).norm(); }
};

/// A passage of a wall, or a leaf that closes one.
struct IndoorDoor {
  Eigen::Vector2d a, b;  ///< ends of the opening
  double height_m = 0;   ///< of its head above the floor; 0: none was seen
  bool closed = false;
  std::array<int, 2> rooms{-1, -1};  ///< indices that it joins; -1: unknown
};

/// A part of the free space between walls and doors.
struct IndoorRoom {
  std::string label;                     ///< "corridor 1", "room 2"
  std::vector<Eigen::Vector2d> outline;  ///< closed polygon, counter-clockwise in (x, z)
  std::vector<std::vector<Eigen::Vector2d>> holes;
  double area_m2 = 0;
  double ceiling_m = 0;  ///< above the floor; 0: not seen
  bool entered = false;  ///< the camera was in it
  std::vector<PlaceId> places;
};

/// Walls, doors and rooms seen from above. Plan coordinates are x and z of a frame with y straight
/// down: the map's own, turned by `R_plan_map` so that its vertical is the building's.
struct IndoorMap {
  /// Too few data (no upright surfaces), degenerate (no vertical, no floor).
  Outcome outcome;
  SO3 R_plan_map;
  double floor_y = 0;  ///< of the floor in the plan frame, y down
  double yaw_rad = 0;  ///< of the walls' directions: x towards z, modulo a quarter turn
  std::vector<IndoorWall> walls;
  std::vector<IndoorDoor> doors;
  std::vector<IndoorRoom> rooms;
  /// Cells of the plan, rows along the second axis of the walls: log-odds that something stands
  /// there at any height, 0 where nothing is known.
  struct Cells {
    double size_m = 0.1;
    Eigen::Vector2d low = Eigen::Vector2d::Zero();  ///< corner, in the walls' axes [m]
    int columns = 0, rows = 0;
    std::vector<float> log_odds;
  } cells;
};

}  // namespace placegraph
