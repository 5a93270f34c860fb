#include <placegraph/io/synthetic/render/hash_noise.h>
#include <placegraph/io/synthetic/worlds/building_layout.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace placegraph::synthetic {
namespace {

Eigen::Vector3d lift(const Eigen::Vector2d& p, double y) { return {p[0], y, p[1]}; }

class WallBuilder {
 public:
  WallBuilder(const PlanWall& wall, Scene& scene, std::uint32_t seed)
      : wall_(wall), scene_(scene), seed_(seed) {
    axis_ = (wall.b - wall.a).normalized();
    across_ = Eigen::Vector2d(-axis_[1], axis_[0]) * (0.5 * wall.thickness_m);
    for (const int side : {0, 1}) {
      const Eigen::Vector2d n = (side ? 1.0 : -1.0) * across_.normalized();
      planes_[side] = scene.add_plane(lift(n, 0), lift(wall.a + (side ? 1.0 : -1.0) * across_, 0));
    }
  }

  void build() {
    const double length = (wall_.b - wall_.a).norm();
    double from = 0;
    for (const Opening& opening : wall_.openings) {
      if (opening.from_m > from) add_piece(from, opening.from_m, 0, wall_.height_m);
      add_piece(opening.from_m, opening.to_m, opening.head_m, wall_.height_m);
      if (opening.leaf != Opening::Leaf::kNone) add_leaf(opening);
      from = opening.to_m;
    }
    if (length > from) add_piece(from, length, 0, wall_.height_m);
    part_.finish();
    scene_.parts.push_back(std::move(part_));
  }

 private:
  void add_face(const Eigen::Vector3d& o, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                const Eigen::Vector3d& outwards, Material material, SurfaceClass label, int plane,
                bool two_sided = false) {
    const std::uint32_t seed =
        mix_bits(seed_ + 31U * static_cast<std::uint32_t>(part_.faces.size()));
    Face face = make_quad(o, a, b, material, label, seed);
    if (face.normal.dot(outwards) < 0) face = make_quad(o + a, -a, b, material, label, seed);
    face.plane = plane;
    face.style = hash_unit(seed_, 3);
    face.light = indoor_light(face.normal);
    face.two_sided = two_sided;
    part_.faces.push_back(face);
  }

  /// The wall between two distances along it and two heights: sides, ends and underside.
  void add_piece(double from, double to, double bottom, double top) {
    const Eigen::Vector2d a = wall_.a + from * axis_, b = wall_.a + to * axis_;
    const Eigen::Vector3d along = lift(b - a, 0), up(0, bottom - top, 0), across = lift(across_, 0);
    for (const int side : {0, 1}) {
      const Eigen::Vector3d off = (side ? 1.0 : -1.0) * across;
      add_face(lift(a, -bottom) + off, along, up, off, Material::kIndoorWall,
               SurfaceClass::kIndoorWall, planes_[side]);
      // One texture for the whole side, measured from the wall's first end and the floor.
      Face& face = part_.faces.back();
      face.seed = mix_bits(seed_ + 7U + static_cast<std::uint32_t>(side));
      face.s_axis = lift(axis_, 0);
      face.origin = lift(wall_.a, 0) + off;
    }
    for (const int end : {0, 1}) {
      const Eigen::Vector2d& at = end ? b : a;
      const Eigen::Vector3d outwards = (end ? 1.0 : -1.0) * lift(axis_, 0);
      add_face(lift(at, -bottom) - across, 2 * across, up, outwards, Material::kConcrete,
               SurfaceClass::kIndoorWall, 0);
    }
    if (bottom > 0) {
      add_face(lift(a, -bottom) - across, along, 2 * across, Eigen::Vector3d::UnitY(),
               Material::kConcrete, SurfaceClass::kIndoorWall, 0);
    } else {
      const Eigen::Vector2d middle = 0.5 * (a + b);
      scene_.solids.push_back({middle, axis_, 0.5 * (to - from), 0.5 * wall_.thickness_m});
    }
  }

  void add_leaf(const Opening& opening) {
    const Eigen::Vector2d hinge = wall_.a + opening.from_m * axis_;
    const double width = opening.to_m - opening.from_m;
    const bool closed = opening.leaf == Opening::Leaf::kClosed;
    const double side_of = opening.leaf == Opening::Leaf::kOpenRight ? -1 : 1;
    const Eigen::Vector2d swing = closed ? axis_ : Eigen::Vector2d(side_of * across_.normalized());
    const Eigen::Vector2d foot = closed ? hinge : hinge + side_of * across_ + 0.03 * axis_;
    const Eigen::Vector2d thick = 0.04 * Eigen::Vector2d(-swing[1], swing[0]);
    for (const double side : {-0.5, 0.5}) {
      const Eigen::Vector3d o = lift(foot + side * thick, 0);
      add_face(o, lift(width * swing, 0), {0, -opening.head_m, 0}, side * lift(thick, 0),
               Material::kDoor, SurfaceClass::kDoor,
               scene_.add_plane(2 * side * lift(thick, 0).normalized(), o));
    }
    if (!closed) {
      add_face(lift(foot + width * swing - 0.5 * thick, 0), lift(thick, 0), {0, -opening.head_m, 0},
               lift(swing, 0), Material::kConcrete, SurfaceClass::kDoor, 0);
    }
    scene_.solids.push_back({foot + 0.5 * width * swing, swing, 0.5 * width, 0.02});
  }

  const PlanWall& wall_;
  Scene& scene_;
  std::uint32_t seed_;
  Eigen::Vector2d axis_, across_;
  int planes_[2] = {0, 0};
  Part part_;
};

void add_room(const PlanRoom& room, Scene& scene, std::uint32_t seed) {
  Part part;
  const Eigen::Vector3d along(room.high[0] - room.low[0], 0, 0),
      across(0, 0, room.high[1] - room.low[1]);
  for (const bool floor : {true, false}) {
    const double y = floor ? 0 : -room.ceiling_m;
    Face face = make_quad(lift(room.low, y), along, across,
                          floor ? Material::kIndoorFloor : Material::kCeiling,
                          floor ? SurfaceClass::kFloor : SurfaceClass::kCeiling, seed + floor);
    face.normal = Eigen::Vector3d(0, floor ? -1 : 1, 0);
    face.origin = Eigen::Vector3d::Zero();
    face.s_axis = Eigen::Vector3d::UnitX();
    face.t_axis = Eigen::Vector3d::UnitZ();
    face.style = room.floor_style;
    face.light = indoor_light(face.normal);
    face.plane = scene.add_plane(face.normal, lift(room.low, y));
    part.faces.push_back(face);
  }
  part.finish();
  scene.parts.push_back(std::move(part));
}

}  // namespace

float indoor_light(const Eigen::Vector3d& normal) {
  return static_cast<float>(0.92 + 0.05 * normal[0] + 0.08 * normal[2] - 0.06 * normal[1]);
}

void BuildingLayout::add_ring(const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                              double height_m, double thickness_m) {
  const Eigen::Vector2d se(high[0], low[1]), nw(low[0], high[1]);
  walls.push_back({low, se, height_m, thickness_m, {}});
  walls.push_back({se, high, height_m, thickness_m, {}});
  walls.push_back({high, nw, height_m, thickness_m, {}});
  walls.push_back({nw, low, height_m, thickness_m, {}});
}

void build_rooms(const BuildingLayout& plan, Scene& scene) {
  std::uint32_t seed = scene.seed;
  for (const PlanRoom& room : plan.rooms) add_room(room, scene, seed += 101);
  for (const PlanWall& wall : plan.walls) WallBuilder(wall, scene, seed += 101).build();
}

void add_furniture(Scene& scene, const Eigen::Vector2d& centre, const Eigen::Vector2d& axis,
                   const Eigen::Vector3d& size, double base_y, Material material,
                   std::uint32_t seed) {
  Part part;
  add_box(part, lift(centre, base_y), lift(axis, 0), lift({-axis[1], axis[0]}, 0), size, material,
          material, SurfaceClass::kFurniture, seed, false);
  for (Face& face : part.faces) {
    face.light = indoor_light(face.normal);
    if (size.minCoeff() > 0.2) face.plane = scene.add_plane(face.normal, face.corners[0]);
  }
  part.finish();
  scene.parts.push_back(std::move(part));
  if (base_y > -1.8) scene.solids.push_back({centre, axis, 0.5 * size[0], 0.5 * size[2]});
}

std::string to_json(const BuildingLayout& plan, const Eigen::Vector2d& origin, double height_m) {
  using nlohmann::ordered_json;
  const auto point = [&](const Eigen::Vector2d& p) {
    return ordered_json::array({p[0] - origin[0], p[1] - origin[1]});
  };
  ordered_json json;
  json["units"] = "m";
  json["frame"] = "x and z of poses.txt; the floor is the plane y = floor_y, y points down";
  json["floor_y"] = height_m;
  json["rooms"] = ordered_json::array();
  for (const PlanRoom& room : plan.rooms) {
    json["rooms"].push_back({{"name", room.name},
                             {"low", point(room.low)},
                             {"high", point(room.high)},
                             {"ceiling_m", room.ceiling_m}});
  }
  json["walls"] = ordered_json::array();
  for (const PlanWall& wall : plan.walls) {
    ordered_json doors = ordered_json::array();
    for (const Opening& opening : wall.openings) {
      const Eigen::Vector2d axis = (wall.b - wall.a).normalized();
      doors.push_back({{"a", point(wall.a + opening.from_m * axis)},
                       {"b", point(wall.a + opening.to_m * axis)},
                       {"height_m", opening.head_m},
                       {"closed", opening.leaf == Opening::Leaf::kClosed}});
    }
    json["walls"].push_back({{"a", point(wall.a)},
                             {"b", point(wall.b)},
                             {"height_m", wall.height_m},
                             {"thickness_m", wall.thickness_m},
                             {"doors", doors}});
  }
  return json.dump(1) + "\n";
}

}  // namespace placegraph::synthetic
