#include <placegraph/io/synthetic/render/world.h>

#include <algorithm>

namespace placegraph::synthetic {

const char* to_string(SurfaceClass label) {
  static constexpr const char* kNames[] = {
      "sky",   "road",    "pavement",    "kerb", "terrain",  "building",
      "roof",  "wall",    "vegetation",  "pole", "sign",     "car",
      "floor", "ceiling", "indoor_wall", "door", "furniture"};
  return kNames[static_cast<int>(label)];
}

const char* street_class_name(SurfaceClass label) {
  switch (label) {
    case SurfaceClass::kSky:
      return "Sky";
    case SurfaceClass::kRoad:
      return "Road";
    case SurfaceClass::kPavement:
    case SurfaceClass::kKerb:
      return "Pavement";
    case SurfaceClass::kBuilding:
    case SurfaceClass::kRoof:
      return "Building";
    case SurfaceClass::kWall:
      return "Fence";
    case SurfaceClass::kVegetation:
      return "Tree";
    case SurfaceClass::kPole:
      return "Pole";
    case SurfaceClass::kSign:
      return "Sign";
    case SurfaceClass::kCar:
      return "Car";
    default:
      return nullptr;
  }
}

void Part::finish() {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e30), high = -low;
  for (const Face& face : faces) {
    for (int i = 0; i < face.count; ++i) {
      low = low.cwiseMin(face.corners[i]);
      high = high.cwiseMax(face.corners[i]);
    }
  }
  centre = faces.empty() ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(0.5 * (low + high));
  radius = faces.empty() ? 0 : 0.5 * (high - low).norm();
}

bool Footprint::overlaps(const Footprint& other) const {
  // Separating axes of two rectangles: the two sides of each.
  const Eigen::Vector2d between = other.centre - centre;
  for (const Footprint* f : {this, &other}) {
    const Eigen::Vector2d sides[2] = {f->axis, Eigen::Vector2d(-f->axis[1], f->axis[0])};
    for (const Eigen::Vector2d& n : sides) {
      const auto reach = [&](const Footprint& g) {
        return std::abs(n.dot(g.axis)) * g.half_length +
               std::abs(n.dot(Eigen::Vector2d(-g.axis[1], g.axis[0]))) * g.half_width;
      };
      if (std::abs(n.dot(between)) > reach(*this) + reach(other)) return false;
    }
  }
  return true;
}

double Footprint::distance(const Eigen::Vector2d& p) const {
  const Eigen::Vector2d d = p - centre;
  const double along = std::max(0.0, std::abs(d.dot(axis)) - half_length);
  const double across =
      std::max(0.0, std::abs(d.dot(Eigen::Vector2d(-axis[1], axis[0]))) - half_width);
  return std::sqrt(along * along + across * across);
}

int Scene::add_plane(const Eigen::Vector3d& normal, const Eigen::Vector3d& point) {
  if (planes.size() >= 65535) return 0;  // ids are written with 16 bits
  planes.emplace_back(normal[0], normal[1], normal[2], normal.dot(point));
  return static_cast<int>(planes.size()) - 1;
}

float outdoor_light(const Eigen::Vector3d& normal) {
  static const Eigen::Vector3d kSun = Eigen::Vector3d(0.55, -0.70, -0.45).normalized();
  const double direct = std::max(0.0, normal.dot(kSun));
  const double sky = 0.5 - 0.5 * normal[1];  // y points down
  return static_cast<float>(0.28 + 0.86 * direct + 0.26 * sky);
}

Face make_quad(const Eigen::Vector3d& o, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
               Material material, SurfaceClass label, std::uint32_t seed) {
  Face face;
  face.corners = {o, o + a, o + a + b, o + b};
  face.normal = a.cross(b).normalized();
  face.origin = o;
  face.s_axis = a.normalized();
  face.t_axis = face.normal.cross(face.s_axis);
  face.material = material;
  face.label = label;
  face.seed = seed;
  face.width = static_cast<float>(a.norm());
  face.height = static_cast<float>(b.norm());
  return face;
}

void add_box(Part& part, const Eigen::Vector3d& base, const Eigen::Vector3d& x_axis,
             const Eigen::Vector3d& z_axis, const Eigen::Vector3d& size, Material side,
             Material top, SurfaceClass label, std::uint32_t seed, bool outdoor) {
  const Eigen::Vector3d up(0, -size[1], 0), x = x_axis * size[0], z = z_axis * size[2];
  const Eigen::Vector3d o = base - 0.5 * x - 0.5 * z;
  const Eigen::Vector3d ring[4] = {o, o + x, o + x + z, o + z};
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d &from = ring[i], &to = ring[(i + 1) % 4];
    Face face = make_quad(from, to - from, up, side, label, seed + 17U * i);
    // A wall whose normal points into the box is reversed.
    if (face.normal.dot(face.corners[0] - base) < 0)
      face = make_quad(to, from - to, up, side, label, seed + 17U * i);
    part.faces.push_back(face);
  }
  const Eigen::Vector3d roof = o + up;
  Face lid = make_quad(roof, x, z, top, label, seed + 101);
  if (lid.normal[1] > 0) lid = make_quad(roof + z, x, -z, top, label, seed + 101);
  part.faces.push_back(lid);
  if (outdoor) {
    for (std::size_t i = part.faces.size() - 5; i < part.faces.size(); ++i)
      part.faces[i].light = outdoor_light(part.faces[i].normal);
  }
}

}  // namespace placegraph::synthetic
