#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace placegraph {

/// A building as it is known to be, seen from above: (x, z) of the frame of poses.txt [m].
struct BuildingPlan {
  struct Room {
    std::string name;
    Eigen::Vector2d low, high;  ///< reaches to the middle of its walls
    double ceiling_m = 0;
  };
  struct Wall {
    Eigen::Vector2d a, b;  ///< of its middle line
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
