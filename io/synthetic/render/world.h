#pragma once
#include <placegraph/graph/geometry/se3.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace placegraph::synthetic {

class RoadField;

/// The class of a pixel's surface; written unchanged into labels_0/, world.yaml lists the names.
enum class SurfaceClass : std::uint8_t {
  kSky,
  kRoad,
  kPavement,
  kKerb,
  kTerrain,
  kBuilding,
  kRoof,
  kWall,
  kVegetation,
  kPole,
  kSign,
  kCar,
  kFloor,
  kCeiling,
  kIndoorWall,
  kDoor,
  kFurniture,
  kCount
};
const char* to_string(SurfaceClass label);
/// The class of a surface in datasets of labelled street images: kerbs are pavement, roofs
/// building, walls and fences fence, hedges and trees tree. Null for a surface without such a
/// class.
const char* street_class_name(SurfaceClass label);

/// How a surface is shaded from its metric surface coordinates; see materials.h.
enum class Material : std::uint8_t {
  kRoad,
  kRoadside,
  kKerb,
  kTerrain,
  kFacade,
  kRoof,
  kMasonry,
  kFence,
  kFoliage,
  kBark,
  kMetal,
  kSign,
  kCarSide,
  kCarEnd,
  kCarTop,
  kGlass,
  kShadow,
  kIndoorWall,
  kIndoorFloor,
  kCeiling,
  kDoor,
  kShelf,
  kCarton,
  kConcrete,
  kGlyph,  ///< `seed` is the index in Scene::glyphs
  kBeacon
};

/// A convex planar polygon with 3 or 4 corners. Its surface coordinates [m] are
/// s = s_axis . (p - origin), t = t_axis . (p - origin); the axes are unit vectors on it.
struct Face {
  std::array<Eigen::Vector3d, 4> corners;
  int count = 4;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit normal; only this side is visible
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d s_axis = Eigen::Vector3d::UnitX();
  Eigen::Vector3d t_axis = Eigen::Vector3d::UnitZ();
  Material material = Material::kConcrete;
  SurfaceClass label = SurfaceClass::kBuilding;
  bool two_sided = false;
  std::uint32_t seed =
      0;          ///< seed of its texture; it continues across faces of equal material and seed
  int plane = 0;  ///< index in planes.txt; 0 = not planar or not listed
  float width = 1, height = 1;  ///< extent in s and t [m], for materials with a layout
  float style = 0;              ///< meaning depends on the material
  float light = 1;              ///< irradiance, 1 = full sun
};

/// Faces that are drawn or left out together.
struct Part {
  std::vector<Face> faces;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0;  ///< radius of a sphere around all corners [m]
  void finish();      ///< computes centre and radius
};

/// A moving object: a part in its own frame and its pose at a time; no pose where it is absent.
struct MovingObject {
  Part part;
  std::function<std::optional<SE3>(double time_s)> T_scene_object;
};

/// A vertical prism that is an obstacle for driving: the ground plan of a solid.
struct Footprint {
  Eigen::Vector2d centre, axis;            ///< (x, z) [m]; unit direction of the first side
  double half_length = 0, half_width = 0;  ///< [m]
  bool overlaps(const Footprint& other) const;
  /// Distance from a point to the rectangle, 0 inside [m].
  double distance(const Eigen::Vector2d& p) const;
};

/// A square pattern of cells of a marker, in rows from the top left of the upright marker.
struct Glyph {
  int cells = 0;  ///< cells per side, including the black border
  std::vector<bool> white;
};

/// A scene: y points down (KITTI's camera axes), metres. A world file fills it.
struct Scene {
  std::vector<Part> parts;
  std::vector<MovingObject> movers;
  std::vector<Footprint> solids;          ///< ground plans of all static objects on the ground
  std::shared_ptr<const RoadField> road;  ///< input of kRoad and kRoadside; may be null
  std::vector<Eigen::Vector4d> planes{Eigen::Vector4d::Zero()};  ///< n, d with n . p = d; 0 unused
  std::vector<Glyph> glyphs;
  bool outdoor = true;  ///< sky and skyline are drawn where there is no face
  std::uint32_t seed = 0;

  int add_plane(const Eigen::Vector3d& normal, const Eigen::Vector3d& point);
};

/// Irradiance of a surface with this unit normal under the scene's one sun and the open sky.
float outdoor_light(const Eigen::Vector3d& normal);

/// A quad o, o + a, o + a + b, o + b with s along a and t along b; its normal is a x b.
Face make_quad(const Eigen::Vector3d& o, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
               Material material, SurfaceClass label, std::uint32_t seed);

/// A box standing on `base` (centre of its floor): `x_axis`, `z_axis` horizontal unit vectors,
/// sizes along x, up, z [m]. Sides run t upwards. `top` is the material of its upper face.
void add_box(Part& part, const Eigen::Vector3d& base, const Eigen::Vector3d& x_axis,
             const Eigen::Vector3d& z_axis, const Eigen::Vector3d& size, Material side,
             Material top, SurfaceClass label, std::uint32_t seed, bool outdoor = true);

}  // namespace placegraph::synthetic
