#include <placegraph/io/synthetic/render/hash_noise.h>
#include <placegraph/io/synthetic/worlds/town_builder.h>

#include <algorithm>

namespace placegraph::synthetic {
namespace {

Eigen::Vector3d lift(const Eigen::Vector2d& p, double y) { return {p[0], y, p[1]}; }

Footprint square(const Eigen::Vector2d& centre, const Eigen::Vector2d& axis, double half) {
  return {centre, axis, half, half};
}

/// An uneven ball of foliage: rings of triangles around a vertical axis.
void add_clump(Part& part, const Eigen::Vector3d& centre, double radius, double height,
               std::uint32_t seed) {
  constexpr int kSides = 7, kRings = 4;
  static constexpr double kCos[kSides] = {1,        0.62349,  -0.22252, -0.90097,
                                          -0.90097, -0.22252, 0.62349};
  static constexpr double kSin[kSides] = {0,        0.78183,  0.97493, 0.43388,
                                          -0.43388, -0.97493, -0.78183};
  static constexpr double kWide[kRings] = {0.66, 1.0, 0.92, 0.52};
  static constexpr double kHigh[kRings] = {-0.38, -0.12, 0.16, 0.38};
  Eigen::Vector3d ring[kRings][kSides];
  for (int r = 0; r < kRings; ++r) {
    for (int i = 0; i < kSides; ++i) {
      const double bump = 0.78 + 0.34 * hash_unit(hash_cell(r, i, seed));
      const double rise = height * (kHigh[r] + 0.14 * (hash_unit(hash_cell(r, i, seed + 1)) - 0.5));
      ring[r][i] = centre + Eigen::Vector3d(radius * kWide[r] * bump * kCos[i], -rise,
                                            radius * kWide[r] * bump * kSin[i]);
    }
  }
  const auto add = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                       const Eigen::Vector3d& c) {
    Face face = make_quad(a, b - a, c - a, Material::kFoliage, SurfaceClass::kVegetation, seed);
    face.count = 3;
    face.corners = {a, b, c, c};
    if (face.normal.dot(a - centre) < 0) face.normal = -face.normal;
    // Axes by the dominant direction, so that neighbouring triangles mostly share the texture.
    const Eigen::Vector3d n = face.normal.cwiseAbs();
    face.origin = Eigen::Vector3d::Zero();
    face.s_axis = n[0] > n[2] && n[0] > n[1] ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
    face.t_axis = n[1] > n[0] && n[1] > n[2] ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
    // Leaves scatter: light and shade of a crown differ less than those of a wall.
    face.light = 0.35F + 0.6F * outdoor_light(face.normal);
    part.faces.push_back(face);
  };
  const Eigen::Vector3d half(0, 0.5 * height, 0);
  for (int i = 0; i < kSides; ++i) {
    const int j = (i + 1) % kSides;
    for (int r = 0; r + 1 < kRings; ++r) {
      add(ring[r][i], ring[r][j], ring[r + 1][i]);
      add(ring[r][j], ring[r + 1][j], ring[r + 1][i]);
    }
    add(ring[0][i], ring[0][j], centre + half);
    add(ring[kRings - 1][i], ring[kRings - 1][j], centre - half);
  }
}

/// A crown of several clumps that reach into each other.
void add_crown(Part& part, const Eigen::Vector3d& centre, double radius, double height,
               std::uint32_t seed) {
  add_clump(part, centre, 0.72 * radius, 0.9 * height, seed);
  const int clumps = 3 + static_cast<int>(seed % 3U);
  for (int i = 0; i < clumps; ++i) {
    const auto unit = [&](int salt) { return hash_unit(hash_cell(i, salt, seed)) - 0.5; };
    const double size = 0.42 + 0.2 * (unit(4) + 0.5);
    const Eigen::Vector3d off(1.1 * radius * unit(1), 0.7 * height * unit(2),
                              1.1 * radius * unit(3));
    add_clump(part, centre + off, size * radius, size * height, seed + 11U * (i + 1U));
  }
}

void add_tree(TownSite& site, const Eigen::Vector2d& at, const Eigen::Vector2d& axis,
              double free_radius) {
  Random& random = site.random;
  const double trunk = random.uniform(1.9, 2.8),
               radius = std::min(random.uniform(1.3, 2.6), free_radius);
  const double height = random.uniform(2.6, 5.0);
  const std::uint32_t seed = random.next();
  Part part;
  const double y = site.walkway(at);
  const Eigen::Vector3d x(axis[0], 0, axis[1]), z(-axis[1], 0, axis[0]);
  const double width = random.uniform(0.16, 0.32);
  add_box(part, lift(at, y + 0.5), x, z, {width, trunk + 1.2, width}, Material::kBark,
          Material::kBark, SurfaceClass::kVegetation, seed);
  add_crown(part, lift(at, y - trunk - 0.5 * height), radius, height, seed + 5);
  site.add(std::move(part), square(at, axis, 0.5 * width));
}

void add_pole(TownSite& site, const Station& at, const Eigen::Vector2d& p, bool lamp) {
  Random& random = site.random;
  const std::uint32_t seed = random.next();
  const Eigen::Vector3d x(at.along[0], 0, at.along[1]), z(at.outward[0], 0, at.outward[1]);
  Part part;
  const double y = site.walkway(p);
  const double high = lamp ? random.uniform(5.0, 7.5) : random.uniform(2.4, 3.2);
  add_box(part, lift(p, y + 0.5), x, z, {0.12, high + 0.5, 0.12}, Material::kMetal,
          Material::kMetal, SurfaceClass::kPole, seed);
  if (lamp) {
    const Eigen::Vector3d arm = lift(p, y - high + 0.15) - 0.5 * z;
    add_box(part, arm, x, z, {0.10, 0.10, 1.1}, Material::kMetal, Material::kMetal,
            SurfaceClass::kPole, seed + 1);
    add_box(part, arm - 0.6 * z + Eigen::Vector3d(0, 0.10, 0), x, z, {0.3, 0.14, 0.5},
            Material::kConcrete, Material::kConcrete, SurfaceClass::kPole, seed + 2);
  } else {
    const double w = random.uniform(0.5, 1.0), h = random.uniform(0.5, 0.9);
    // The board faces both directions of the road.
    for (const double facing : {-1.0, 1.0}) {
      const Eigen::Vector3d o =
          lift(p, y - high + h + 0.05) - facing * 0.5 * w * z + facing * 0.075 * x;
      Face face = make_quad(o, facing * w * z, Eigen::Vector3d(0, -h, 0), Material::kSign,
                            SurfaceClass::kSign, seed + 3);
      if (face.normal.dot(facing * x) < 0)
        face = make_quad(o + facing * w * z, -facing * w * z, Eigen::Vector3d(0, -h, 0),
                         Material::kSign, SurfaceClass::kSign, seed + 3);
      face.light = outdoor_light(face.normal);
      face.plane = site.scene.add_plane(face.normal, o);
      part.faces.push_back(face);
    }
  }
  site.add(std::move(part), square(p, at.along, 0.08));
}

/// A garden wall, fence or hedge along the back of the pavement.
void add_border(TownSite& site, const Footprint& f, std::uint32_t seed) {
  const float kind = hash_unit(seed, 1);
  const double high = 0.5 + 1.1 * hash_unit(seed, 2);
  const Material material = kind < 0.35F   ? Material::kMasonry
                            : kind < 0.65F ? Material::kFence
                                           : Material::kFoliage;
  const SurfaceClass label = kind < 0.65F ? SurfaceClass::kWall : SurfaceClass::kVegetation;
  Part part;
  const Eigen::Vector3d x(f.axis[0], 0, f.axis[1]), z(-f.axis[1], 0, f.axis[0]);
  double low = -1e9, top = 1e9;
  for (const double end : {-1.0, 1.0}) {
    const double y = site.walkway(f.centre + end * f.half_length * f.axis);
    low = std::max(low, y);
    top = std::min(top, y);
  }
  const double buried = low - top + 0.4;
  add_box(part, lift(f.centre, top + buried), x, z,
          {2 * f.half_length, high + buried, 2 * f.half_width}, material,
          material == Material::kFence ? Material::kBark : material, label, seed);
  for (Face& face : part.faces) {
    face.height = static_cast<float>(high);
    if (std::abs(face.normal[1]) < 0.5) face.origin[1] = top;
  }
  site.add(std::move(part), f);
}

void add_parked_car(TownSite& site, const Footprint& f, bool forward) {
  const Eigen::Vector2d axis = forward ? f.axis : Eigen::Vector2d(-f.axis);
  const Eigen::Vector2d nose = f.centre + 1.4 * axis, tail = f.centre - 1.4 * axis;
  const double slope = (site.walkway(nose) - site.walkway(tail)) / 2.8;
  const Eigen::Vector3d z = Eigen::Vector3d(axis[0], slope, axis[1]).normalized();
  const Eigen::Vector3d x = Eigen::Vector3d(axis[1], 0, -axis[0]);
  Eigen::Matrix3d R;
  R << x, z.cross(x), z;
  site.add(
      transformed(make_car(site.random.next()), SE3(R, lift(f.centre, site.walkway(f.centre)))), f);
}

void furnish(TownSite& site, const Roadway& roadway, int side) {
  Random& random = site.random;
  const double total = length(roadway);
  // Parked cars first, they need the most room; whole stretches without any.
  bool parking = random.uniform() < 0.6;
  for (double s = random.uniform(2, 8); s < total; s += random.uniform(5.0, 8.0)) {
    if (random.uniform() < 0.1) parking = !parking;
    if (!parking || random.uniform() < 0.25) continue;
    const auto at = station(roadway, s, side);
    if (!at) break;
    const Footprint f{
        at->centre + at->outward * (at->half_width_m + 1.15 + random.uniform(-0.1, 0.15)),
        at->along, 2.15, 0.88};
    if (site.is_free(f, 0.08))
      add_parked_car(site, f, random.uniform() < 0.8 ? side > 0 : side < 0);
  }
  for (double s = random.uniform(3, 12); s < total; s += random.uniform(11, 24)) {
    const auto at = station(roadway, s, side);
    if (!at) break;
    const Eigen::Vector2d p = at->centre + at->outward * (at->half_width_m + 0.45);
    if (site.is_free(square(p, at->along, 0.2), 0.2))
      add_pole(site, *at, p, random.uniform() < 0.6);
  }
  for (double s = random.uniform(2, 9); s < total; s += random.uniform(6, 17)) {
    const auto at = station(roadway, s, side);
    if (!at) break;
    const double off = random.uniform(2.2, 4.5);
    const Eigen::Vector2d p = at->centre + at->outward * (at->half_width_m + off);
    const double edge = site.road.edge_distance(p[0], p[1]);
    if (edge > 2.0 && site.is_free(square(p, at->along, 0.7), 1.2))
      add_tree(site, p, at->along, edge);
  }
  for (double s = random.uniform(0, 6); s < total; s += random.uniform(2, 7)) {
    const double long_m = random.uniform(3, 9);
    const auto at = station(roadway, s + 0.5 * long_m, side);
    if (!at) break;
    const Footprint f{at->centre + at->outward * (at->half_width_m + 2.85), at->along, 0.5 * long_m,
                      0.14};
    const std::uint32_t seed = random.next();
    if (site.is_free(f, 2.5)) {
      add_border(site, f, seed);
      s += long_m;
    }
  }
}

/// Trees and bushes on open ground, so that gaps between houses are not empty.
void scatter(TownSite& site, const Roadway& roadway, int side) {
  Random& random = site.random;
  const double total = length(roadway);
  for (double s = 0; s < total; s += random.uniform(3, 8)) {
    const auto at = station(roadway, s, side);
    if (!at) break;
    const Eigen::Vector2d p = at->centre + at->outward * (at->half_width_m + random.uniform(5, 22));
    if (site.is_free(square(p, at->along, 1.2), 4)) add_tree(site, p, at->along, 3);
  }
}

/// A car's cabin: a frustum with slanted panes on the deck of the body, in the car's frame.
struct Cabin {
  double z0, z1;                          ///< its ends on the deck
  double half_width, deck, roof;          ///< heights of deck and roof above the ground
  double in = 0.16;                       ///< inward slant of a side up to the roof
  double r0 = z0 + 0.35, r1 = z1 - 0.62;  ///< ends of the roof
};

/// The panes at both sides, in front and behind.
void add_panes(Part& part, const Cabin& cabin, float paint, std::uint32_t seed) {
  const auto& [z0, z1, hw, deck, roof, in, r0, r1] = cabin;
  const double rise = roof - deck;
  const auto finish = [&](Face& face) {
    if (face.t_axis[1] > 0) face.t_axis = -face.t_axis;
    face.height = static_cast<float>(rise);
    face.style = paint;
    face.light = outdoor_light(face.normal);
    part.faces.push_back(face);
  };
  for (const double side : {-1.0, 1.0}) {
    const Eigen::Vector3d a(side * hw, -deck, z0), b(side * hw, -deck, z1),
        c(side * (hw - in), -roof, r1), d(side * (hw - in), -roof, r0);
    Face face = make_quad(a, b - a, d - a, Material::kGlass, SurfaceClass::kCar, seed + 31U);
    if (face.normal.dot(side * Eigen::Vector3d::UnitX()) < 0) face.normal = -face.normal;
    face.corners = {a, b, c, d};
    face.t_axis = -(face.s_axis.cross(face.normal));
    finish(face);
  }
  for (const double end : {-1.0, 1.0}) {
    const double zb = end < 0 ? z0 : z1, zr = end < 0 ? r0 : r1;
    const Eigen::Vector3d a(-hw, -deck, zb), b(hw, -deck, zb), c(hw - in, -roof, zr),
        d(-hw + in, -roof, zr);
    Face face = make_quad(a, b - a, 0.5 * (c + d) - 0.5 * (a + b), Material::kGlass,
                          SurfaceClass::kCar, seed + 37U);
    if (face.normal.dot(Eigen::Vector3d(0, -0.3, end)) < 0) face.normal = -face.normal;
    face.corners = {a, b, c, d};
    finish(face);
  }
}

}  // namespace

Part make_car(std::uint32_t seed) {
  const float paint = hash_unit(seed, 1);
  const double l = 4.0 + 0.35 * hash_unit(seed, 2), w = 1.66,
               deck = 0.82 + 0.1 * hash_unit(seed, 3), roof = 1.42 + 0.25 * hash_unit(seed, 4);
  const double hood = l * (0.16 + 0.10 * hash_unit(seed, 5)),
               boot = l * (0.03 + 0.14 * hash_unit(seed, 6));
  Part part;
  const auto quad = [&](const Eigen::Vector3d& o, const Eigen::Vector3d& a,
                        const Eigen::Vector3d& b, Material material,
                        const Eigen::Vector3d& outwards) {
    Face face = make_quad(o, a, b, material, SurfaceClass::kCar, seed + part.faces.size() * 3U);
    if (face.normal.dot(outwards) < 0)
      face = make_quad(o + a, -a, b, material, SurfaceClass::kCar, seed + part.faces.size() * 3U);
    face.style = paint;
    face.light = outdoor_light(face.normal);
    part.faces.push_back(face);
  };
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), z = Eigen::Vector3d::UnitZ();
  const double hw = 0.5 * w, hl = 0.5 * l;
  const Eigen::Vector3d up(0, -deck, 0);
  for (const double side : {-1.0, 1.0}) {
    quad({side * hw, 0, -hl}, l * z, up, Material::kCarSide, side * x);
    quad({-hw, 0, side * hl}, w * x, up, Material::kCarEnd, side * z);
  }
  quad({-hw, -deck, -hl}, w * x, l * z, Material::kCarTop, -Eigen::Vector3d::UnitY());
  const Cabin cabin{-hl + boot, hl - hood, hw, deck, roof};
  add_panes(part, cabin, paint, seed);
  quad({-hw + cabin.in, -roof, cabin.r0}, (w - 2 * cabin.in) * x, (cabin.r1 - cabin.r0) * z,
       Material::kCarTop, -Eigen::Vector3d::UnitY());
  // Its shadow, two centimetres above the ground.
  Face shadow = make_quad({-hw - 0.05, -0.02, -hl}, (w + 0.1) * x, l * z, Material::kShadow,
                          SurfaceClass::kRoad, seed);
  if (shadow.normal[1] > 0)
    shadow = make_quad({-hw - 0.05, -0.02, hl}, (w + 0.1) * x, -l * z, Material::kShadow,
                       SurfaceClass::kRoad, seed);
  part.faces.push_back(shadow);
  part.finish();
  return part;
}

void build_furniture(TownSite& site) {
  for (const Roadway& roadway : site.plan.roads) {
    if (!roadway.lined) continue;
    for (const int side : {-1, 1}) furnish(site, roadway, side);
  }
  for (const Roadway& roadway : site.plan.roads) {
    if (!roadway.lined) continue;
    for (const int side : {-1, 1}) scatter(site, roadway, side);
  }
}

}  // namespace placegraph::synthetic
