#include <placegraph/pipeline/dense/marching_cubes.h>
#include <placegraph/pipeline/dense/mesh_parts.h>
#include <placegraph/pipeline/dense/tsdf_surface.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace placegraph {
namespace {

/// The surface of a TSDF, cube by cube, with vertices that cubes share.
class TsdfSurface {
 public:
  explicit TsdfSurface(const TsdfVolume& volume) : volume_(volume) {}

  /// Adds the triangles between eight voxels, of which this is the one with the least coordinates.
  void add_cube(const VoxelIndex& index);
  TriangleMesh finish() {
    mesh_.normals = vertex_normals(mesh_);
    return std::move(mesh_);
  }

 private:
  /// An edge of the grid: the voxel where it begins, and its axis.
  struct Edge {
    VoxelIndex from{};
    int axis = 0;
    bool operator==(const Edge&) const = default;
  };
  struct EdgeHash {
    std::size_t operator()(const Edge& edge) const {
      return VoxelIndexHash()(edge.from) * 3 + static_cast<std::size_t>(edge.axis);
    }
  };

  std::int32_t vertex_on(const Edge& edge, const TsdfVoxel& from, const TsdfVoxel& to);

  const TsdfVolume& volume_;
  TriangleMesh mesh_;
  std::unordered_map<Edge, std::int32_t, EdgeHash> vertices_;
};

void TsdfSurface::add_cube(const VoxelIndex& index) {
  std::array<const TsdfVoxel*, 8> corners{};
  unsigned inside = 0;
  float least = 0, most = 0;
  for (int i = 0; i < 8; ++i) {
    const TsdfVoxel* voxel =
        volume_.find({index[0] + (i & 1), index[1] + (i >> 1 & 1), index[2] + (i >> 2 & 1)});
    if (!voxel || !(voxel->weight > 0)) return;
    corners[static_cast<std::size_t>(i)] = voxel;
    if (voxel->distance < 0) inside |= 1U << i;
    least = std::min(least, voxel->distance);
    most = std::max(most, voxel->distance);
  }
  // Distances of a surface differ by at most the diagonal of the cube: what differs by more is free
  // on one side, and hidden behind another surface on the other.
  if (inside == 0 || inside == 255 || most - least > 2.5 * volume_.side()) return;
  for (const auto& triangle : cube_triangles(inside)) {
    std::array<std::int32_t, 3> face{};
    for (std::size_t k = 0; k < 3; ++k) {
      const CubeEdge& edge = cube_edges()[triangle[k]];
      VoxelIndex from = index;
      for (int i = 0; i < 3; ++i) from[static_cast<std::size_t>(i)] += edge.from >> i & 1;
      face[k] = vertex_on({from, edge.axis}, *corners[static_cast<std::size_t>(edge.from)],
                          *corners[static_cast<std::size_t>(edge.to)]);
    }
    mesh_.faces.push_back(face);
  }
}

std::int32_t TsdfSurface::vertex_on(const Edge& edge, const TsdfVoxel& from, const TsdfVoxel& to) {
  const auto [entry, is_new] =
      vertices_.try_emplace(edge, static_cast<std::int32_t>(mesh_.positions.size()));
  if (!is_new) return entry->second;
  const double share = from.distance / (double{from.distance} - to.distance);
  Eigen::Vector3d p(edge.from[0], edge.from[1], edge.from[2]);
  p[edge.axis] += share;
  mesh_.positions.push_back(volume_.side() * p);
  std::array<std::uint8_t, 3> rgb{};
  for (std::size_t i = 0; i < 3; ++i)
    rgb[i] = static_cast<std::uint8_t>(
        std::lround((1 - share) * double(from.rgb[i]) + share * double(to.rgb[i])));
  mesh_.rgb.push_back(rgb);
  return entry->second;
}

}  // namespace

TriangleMesh surface_of(const TsdfVolume& volume) {
  constexpr int kSide = TsdfVolume::kBlock;
  TsdfSurface surface(volume);
  for (const VoxelIndex& block : volume.blocks())
    for (int z = 0; z < kSide; ++z)
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
          surface.add_cube({kSide * block[0] + x, kSide * block[1] + y, kSide * block[2] + z});
  return surface.finish();
}

}  // namespace placegraph
