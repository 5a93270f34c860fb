#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace placegraph {

/// Ground truth of a building, seen from above: (x, z) of the frame of poses.txt [m].
struct TrueFloorPlan {
  struct Room {
    std::string name;
    Eigen::Vector2d low, high;  ///< corners; the room extends to the middle of its walls
    double ceiling_m = 0;
  };
  struct Wall {
    Eigen::Vector2d a, b;  ///< ends of its middle line
    double thickness_m = 0, height_m = 0;
  };
  struct Door {
    Eigen::Vector2d a, b;
    double height_m = 0;
    bool closed = false;
    int wall = 0;  ///< index
  };
  std::vector<Room> rooms;
  std::vector<Wall> walls;
  std::vector<Door> doors;
};

}  // namespace placegraph
