#include <placegraph/io/synthetic/render/hash_noise.h>
#include <placegraph/io/synthetic/worlds/town_builder.h>

#include <algorithm>

namespace placegraph::synthetic {
namespace {

constexpr double kFineReach_m = 14;  ///< detailed ground up to here off the asphalt
constexpr double kCoarse_m = 16;
constexpr double kCoarseDrop_m = 0.4;  ///< depth of the coarse ground below the fine one
constexpr double kOuter_m = 320;       ///< coarse ground beyond the last road
constexpr int kCellsPerPart = 20;

struct Vertex {
  Eigen::Vector3d p;
  double edge;
};

class GroundBuilder {
 public:
  GroundBuilder(TownSite& site, Part& part) : site_(site), part_(part) {}

  /// The triangle's road side as it is, its other side lifted by the kerb, a kerb where they part.
  void add_triangle(const Vertex& a, const Vertex& b, const Vertex& c) {
    const Vertex* v[3] = {&a, &b, &c};
    std::vector<Eigen::Vector3d> road, side;
    std::vector<Eigen::Vector3d> crossing;
    for (int i = 0; i < 3; ++i) {
      const Vertex &from = *v[i], &to = *v[(i + 1) % 3];
      (from.edge < 0 ? road : side).push_back(from.p);
      if ((from.edge < 0) != (to.edge < 0)) {
        // The cut is computed from the road's end, so that both triangles on this edge cut it at
        // the same bits.
        const Vertex &in = from.edge < 0 ? from : to, &out = from.edge < 0 ? to : from;
        const Eigen::Vector3d p = in.p + (out.p - in.p) * (in.edge / (in.edge - out.edge));
        road.push_back(p);
        side.push_back(p);
        crossing.push_back(p);
      }
    }
    for (Eigen::Vector3d& p : side) p[1] -= kKerb_m;
    add_polygon(road, Material::kRoad, SurfaceClass::kRoad, 1);
    add_polygon(side, Material::kRoadside, SurfaceClass::kPavement, 2);
    if (crossing.size() == 2 && !road.empty()) add_kerb(crossing[0], crossing[1], road);
  }

  void add_polygon(const std::vector<Eigen::Vector3d>& corners, Material material,
                   SurfaceClass label, std::uint32_t seed) {
    if (corners.size() < 3) return;
    Face face;
    face.count = static_cast<int>(corners.size());
    for (int i = 0; i < face.count; ++i) face.corners[i] = corners[i];
    const Eigen::Vector3d n = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    if (n.norm() < 1e-9) return;
    face.normal = n.normalized() * (n[1] > 0 ? -1 : 1);
    face.s_axis = Eigen::Vector3d::UnitX();  // s = x and t = z of the scene
    face.t_axis = Eigen::Vector3d::UnitZ();
    face.material = material;
    face.label = label;
    face.seed = site_.scene.seed + seed;
    face.light = outdoor_light(-Eigen::Vector3d::UnitY());
    part_.faces.push_back(face);
  }

 private:
  void add_kerb(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                const std::vector<Eigen::Vector3d>& road) {
    if ((b - a).norm() < 1e-3) return;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : road) middle += p / static_cast<double>(road.size());
    const Eigen::Vector3d up(0, -kKerb_m, 0);
    Face face = make_quad(a, b - a, up, Material::kKerb, SurfaceClass::kKerb, site_.scene.seed + 3);
    if (face.normal.dot(middle - a) < 0)
      face = make_quad(b, a - b, up, Material::kKerb, SurfaceClass::kKerb, site_.scene.seed + 3);
    // Joints are a metre apart along the dominant axis, independent of the pieces.
    const bool along_x = std::abs(b[0] - a[0]) > std::abs(b[2] - a[2]);
    face.origin = Eigen::Vector3d::Zero();
    face.s_axis = along_x ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
    face.t_axis = -Eigen::Vector3d::UnitY();
    face.light = outdoor_light(face.normal);
    part_.faces.push_back(face);
  }

  TownSite& site_;
  Part& part_;
};

struct Lattice {
  int x0, z0, nx, nz;  ///< first cell and number of cells
};

std::vector<Vertex> sample_vertices(const TownSite& site, const Lattice& l) {
  const double cell = site.plan.ground.cell_m;
  std::vector<Vertex> vertices(static_cast<std::size_t>(l.nx + 1) * (l.nz + 1));
  for (int z = 0; z <= l.nz; ++z) {
    for (int x = 0; x <= l.nx; ++x) {
      const double px = (l.x0 + x) * cell, pz = (l.z0 + z) * cell;
      Vertex& v = vertices[static_cast<std::size_t>(z) * (l.nx + 1) + x];
      v.edge = site.road.edge_distance(px, pz);
      if (v.edge < kFineReach_m + 8) v.p = {px, site.plan.ground.vertex_height(px, pz), pz};
    }
  }
  return vertices;
}

void add_coarse(TownSite& site, const Lattice& l, const std::vector<char>& fine) {
  const int ratio = static_cast<int>(kCoarse_m / site.plan.ground.cell_m);
  const auto lowest = [&](double at) { return floor_int((at - kOuter_m) / kCoarse_m); };
  const auto highest = [&](double at) { return floor_int((at + kOuter_m) / kCoarse_m) + 1; };
  const HeightSurface& surface = site.plan.ground.surface;
  constexpr int kBlock = 8;
  const int x0 = lowest(site.road.low()[0]), x1 = highest(site.road.high()[0]);
  const int z0 = lowest(site.road.low()[1]), z1 = highest(site.road.high()[1]);
  for (int bz = z0; bz < z1; bz += kBlock) {
    for (int bx = x0; bx < x1; bx += kBlock) {
      Part part;
      GroundBuilder builder(site, part);
      for (int z = bz; z < std::min(z1, bz + kBlock); ++z) {
        for (int x = bx; x < std::min(x1, bx + kBlock); ++x) {
          bool covered = true;
          for (int j = 0; j < ratio && covered; ++j) {
            for (int i = 0; i < ratio && covered; ++i) {
              const int cx = x * ratio + i - l.x0, cz = z * ratio + j - l.z0;
              covered = cx >= 0 && cz >= 0 && cx < l.nx && cz < l.nz &&
                        fine[static_cast<std::size_t>(cz) * l.nx + cx];
            }
          }
          if (covered) continue;
          const auto at = [&](int i, int j) {
            const double px = (x + i) * kCoarse_m, pz = (z + j) * kCoarse_m;
            return Eigen::Vector3d(px, surface.height(px, pz) + kCoarseDrop_m, pz);
          };
          builder.add_polygon({at(0, 0), at(1, 0), at(1, 1)}, Material::kTerrain,
                              SurfaceClass::kTerrain, 4);
          builder.add_polygon({at(0, 0), at(0, 1), at(1, 1)}, Material::kTerrain,
                              SurfaceClass::kTerrain, 4);
        }
      }
      if (!part.faces.empty()) site.add(std::move(part));
    }
  }
}

}  // namespace

void build_ground(TownSite& site) {
  const double cell = site.plan.ground.cell_m;
  Lattice l{};
  l.x0 = floor_int(site.road.low()[0] / cell);
  l.z0 = floor_int(site.road.low()[1] / cell);
  l.nx = floor_int(site.road.high()[0] / cell) + 1 - l.x0;
  l.nz = floor_int(site.road.high()[1] / cell) + 1 - l.z0;
  const std::vector<Vertex> vertices = sample_vertices(site, l);
  std::vector<char> fine(static_cast<std::size_t>(l.nx) * l.nz, 0);
  const auto vertex = [&](int x, int z) -> const Vertex& {
    return vertices[static_cast<std::size_t>(z) * (l.nx + 1) + x];
  };
  for (int bz = 0; bz < l.nz; bz += kCellsPerPart) {
    for (int bx = 0; bx < l.nx; bx += kCellsPerPart) {
      Part part;
      GroundBuilder builder(site, part);
      for (int z = bz; z < std::min(l.nz, bz + kCellsPerPart); ++z) {
        for (int x = bx; x < std::min(l.nx, bx + kCellsPerPart); ++x) {
          const Vertex &a = vertex(x, z), &b = vertex(x + 1, z), &c = vertex(x, z + 1),
                       &d = vertex(x + 1, z + 1);
          if (std::min({a.edge, b.edge, c.edge, d.edge}) >= kFineReach_m) continue;
          fine[static_cast<std::size_t>(z) * l.nx + x] = 1;
          builder.add_triangle(a, b, d);
          builder.add_triangle(a, c, d);
        }
      }
      if (!part.faces.empty()) site.add(std::move(part));
    }
  }
  add_coarse(site, l, fine);
}

}  // namespace placegraph::synthetic
