#include <placegraph/io/synthetic/render/hash_noise.h>
#include <placegraph/io/synthetic/worlds/town_builder.h>

#include <algorithm>

namespace placegraph::synthetic {
namespace {

constexpr double kMinEdge_m = 3.2;  ///< houses stand behind the pavement

struct House {
  Footprint footprint;
  double eaves_m = 6;
  bool gable = true;
  std::uint32_t seed = 0;
};

/// A wall from `a` to `b` (on the ground plan, y = floor level): reaches a metre into the ground.
Face make_wall(Scene& scene, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
               const Eigen::Vector3d& inside, double height, Material material, std::uint32_t seed,
               float style) {
  const Eigen::Vector3d down(0, 1.5, 0), up(0, -height - 1.5, 0);
  const bool reversed = (b - a).cross(up).dot(a - inside) < 0;
  const Eigen::Vector3d &from = reversed ? b : a, &to = reversed ? a : b;
  Face face = make_quad(from + down, to - from, up, material, SurfaceClass::kBuilding, seed);
  face.origin = from;
  face.height = static_cast<float>(height);
  face.style = style;
  face.light = outdoor_light(face.normal);
  face.plane = scene.add_plane(face.normal, from);
  return face;
}

Face make_roof(Scene& scene, const Eigen::Vector3d& o, const Eigen::Vector3d& a,
               const Eigen::Vector3d& b, std::uint32_t seed) {
  Face face = make_quad(o, a, b, Material::kRoof, SurfaceClass::kRoof, seed);
  if (face.normal[1] > 0)
    face = make_quad(o + a, -a, b, Material::kRoof, SurfaceClass::kRoof, seed);
  face.two_sided = true;  // eaves are seen from below
  face.light = outdoor_light(face.normal);
  face.plane = scene.add_plane(face.normal, o);
  return face;
}

void add_gable_roof(Scene& scene, Part& part, const Eigen::Vector3d (&c)[4], double eaves,
                    double rise, std::uint32_t seed, float style) {
  // The ridge runs along c0 -> c1, above the middle of the sides c1 -> c2 and c3 -> c0.
  const Eigen::Vector3d up(0, -eaves, 0), peak(0, -eaves - rise, 0);
  const Eigen::Vector3d along = (c[1] - c[0]).normalized(), across = (c[3] - c[0]).normalized();
  const double depth = (c[3] - c[0]).norm(), over = 0.35;
  const Eigen::Vector3d ridge0 = 0.5 * (c[0] + c[3]) + peak - over * along,
                        ridge1 = 0.5 * (c[1] + c[2]) + peak + over * along;
  const Eigen::Vector3d sag(0, rise * over / (0.5 * depth), 0);
  const Eigen::Vector3d front = c[0] + up - over * along - over * across + sag,
                        back = c[3] + up - over * along + over * across + sag;
  part.faces.push_back(make_roof(scene, front, ridge1 - ridge0, ridge0 - front, seed));
  part.faces.push_back(make_roof(scene, back, ridge1 - ridge0, ridge0 - back, seed));
  for (const int i : {0, 1}) {
    const Eigen::Vector3d &a = i ? c[1] : c[0], &b = i ? c[2] : c[3];
    const Eigen::Vector3d inside = 0.25 * (c[0] + c[1] + c[2] + c[3]);
    Face face = make_wall(scene, a, b, inside, eaves, Material::kFacade, seed + 40 + i, style);
    face.count = 3;
    face.corners = {a + up, b + up, 0.5 * (a + b) + peak, Eigen::Vector3d::Zero()};
    part.faces.push_back(face);
  }
}

void add_house(TownSite& site, const House& house) {
  const Footprint& f = house.footprint;
  const Eigen::Vector2d across(-f.axis[1], f.axis[0]);
  Eigen::Vector3d c[4];
  double level = 0;
  for (int i = 0; i < 4; ++i) {
    const double sx = i == 1 || i == 2 ? 1 : -1, sz = i >= 2 ? 1 : -1;
    const Eigen::Vector2d p = f.centre + sx * f.half_length * f.axis + sz * f.half_width * across;
    c[i] = {p[0], 0, p[1]};
    level += 0.25 * site.walkway(p);
  }
  for (Eigen::Vector3d& p : c) p[1] = level;
  const Eigen::Vector3d inside = 0.25 * (c[0] + c[1] + c[2] + c[3]);
  const float style = hash_unit(house.seed, 77);
  Part part;
  for (int i = 0; i < 4; ++i)
    part.faces.push_back(make_wall(site.scene, c[i], c[(i + 1) % 4], inside, house.eaves_m,
                                   Material::kFacade, house.seed + i, style));
  const double rise = house.gable ? (0.35 + 0.5 * hash_unit(house.seed, 5)) * f.half_width : 0;
  if (house.gable) {
    add_gable_roof(site.scene, part, c, house.eaves_m, rise, house.seed + 20, style);
  } else {
    const Eigen::Vector3d up(0, -house.eaves_m, 0);
    part.faces.push_back(
        make_roof(site.scene, c[0] + up, c[1] - c[0], c[3] - c[0], house.seed + 20));
  }
  const Eigen::Vector3d x(f.axis[0], 0, f.axis[1]), z(across[0], 0, across[1]);
  if (hash_unit(house.seed, 6) < 0.7F) {  // a chimney or a roof hut
    const double at = (hash_unit(house.seed, 7) - 0.5) * f.half_length;
    const Eigen::Vector3d base =
        inside + at * x + 0.3 * f.half_width * z - Eigen::Vector3d(0, house.eaves_m, 0);
    add_box(part, base, x, z, {0.7, rise + 1.0, 0.7}, Material::kMasonry, Material::kConcrete,
            SurfaceClass::kBuilding, house.seed + 60);
  }
  // A bay on either long side, where there is room for it.
  for (const int side : {-1, 1}) {
    if (hash_unit(house.seed, 8 + side) > 0.4F || f.half_length < 3) continue;
    const double width = 2.2 + 1.2 * hash_unit(house.seed, 12), depth = 0.9;
    const double at = (hash_unit(house.seed, 14 + side) - 0.5) * (f.half_length - 2.0);
    const double high =
        std::min(house.eaves_m - 0.4, 2.8 * (1 + floor_int(2.0 * hash_unit(house.seed, 20))));
    const Eigen::Vector3d base = inside + at * x + side * (f.half_width + 0.5 * depth) * z;
    Footprint bay = f;
    bay.centre = {base[0], base[2]};
    bay.half_length = 0.5 * width;
    bay.half_width = 0.5 * depth - 0.02;
    if (!site.is_free(bay, kMinEdge_m - 0.5)) continue;
    add_box(part, base, x, z, {width, high, depth}, Material::kFacade, Material::kConcrete,
            SurfaceClass::kBuilding, house.seed + 70);
    for (std::size_t i = part.faces.size() - 5; i < part.faces.size(); ++i)
      part.faces[i].style = style;
    site.scene.solids.push_back(bay);
  }
  site.add(std::move(part), f);
}

/// Lots along both sides of a road; `row` 0 = at the street, 1 = higher blocks behind.
void line_road(TownSite& site, const Roadway& roadway, int side, int row) {
  Random& random = site.random;
  const double total = length(roadway);
  double s = random.uniform(0, 3);
  while (s < total) {
    House house;
    house.seed = random.next();
    const double width = row ? random.uniform(14, 30) : random.uniform(7, 17);
    const double depth = row ? random.uniform(10, 14) : random.uniform(7, 10);
    const double setback = row ? random.uniform(15, 30) : random.uniform(0.3, 4.5);
    house.eaves_m = row ? random.uniform(9, 22) : random.uniform(3.2, 11);
    house.gable = random.uniform() < (row ? 0.3 : 0.7);
    const auto at = station(roadway, s + 0.5 * width, side);
    if (!at) break;
    Footprint& f = house.footprint;
    f.axis = at->along;
    f.half_length = 0.5 * width;
    f.half_width = 0.5 * depth;
    f.centre = at->centre + at->outward * (at->half_width_m + kMinEdge_m + setback + 0.5 * depth);
    if (site.is_free(f, kMinEdge_m)) {
      add_house(site, house);
      s += width + (random.uniform() < 0.6 ? random.uniform(0.3, 1.5) : random.uniform(2, 8));
    } else {
      s += 3;
    }
  }
}

}  // namespace

void build_houses(TownSite& site) {
  for (int row = 0; row < 2; ++row) {
    for (const Roadway& roadway : site.plan.roads) {
      if (!roadway.lined) continue;
      for (const int side : {-1, 1}) line_road(site, roadway, side, row);
    }
  }
}

}  // namespace placegraph::synthetic
