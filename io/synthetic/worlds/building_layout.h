#pragma once
#include <placegraph/graph/core/random.h>
#include <placegraph/io/synthetic/render/world.h>

#include <string>
#include <vector>

namespace placegraph::synthetic {

/// A hole in a wall, measured from the wall's first end [m].
struct Opening {
  double from_m = 0, to_m = 1, head_m = 2.05;
  enum class Leaf { kNone, kOpenLeft, kOpenRight, kClosed };
  Leaf leaf = Leaf::kNone;  ///< open leaves are at a right angle on that side of a -> b
};

/// A straight wall between two points (x, z) of the plan, on both sides of the line.
struct PlanWall {
  Eigen::Vector2d a, b;
  double height_m = 2.7, thickness_m = 0.16;
  std::vector<Opening> openings;  ///< ascending, not overlapping
};

/// A rectangle of the plan with one floor and one ceiling; reaches to the middle of its walls.
struct PlanRoom {
  std::string name;
  Eigen::Vector2d low, high;
  double ceiling_m = 2.7;
  float floor_style = 0;  ///< 0 tiles, 0.5 boards, 1 concrete
};

/// A building seen from above: (x, z) in metres, the floor at y = 0.
struct BuildingLayout {
  std::vector<PlanRoom> rooms;
  std::vector<PlanWall> walls;

  /// Adds the four walls of a rectangle, its inside on the left of each a -> b.
  void add_ring(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double height_m,
                double thickness_m = 0.16);
};

/// Adds walls with their openings and door leaves, floors and ceilings to an indoor scene.
void build_rooms(const BuildingLayout& plan, Scene& scene);

/// A box of furniture standing on y = base_y (0 = the floor), which is added to the solids too.
void add_furniture(Scene& scene, const Eigen::Vector2d& centre, const Eigen::Vector2d& axis,
                   const Eigen::Vector3d& size, double base_y, Material material,
                   std::uint32_t seed);

/// The plan as JSON, shifted so that its (x, z) are those of a frame at `origin` (scene, x z) with
/// the scene's axes, `height_m` above the floor: the frame of poses.txt.
std::string to_json(const BuildingLayout& plan, const Eigen::Vector2d& origin, double height_m);

/// Irradiance of an indoor surface.
float indoor_light(const Eigen::Vector3d& normal);

}  // namespace placegraph::synthetic
