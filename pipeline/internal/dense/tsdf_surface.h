#pragma once
#include <placegraph/io/internal/exports/surface_ply.h>
#include <placegraph/pipeline/internal/dense/tsdf_volume.h>

#include <array>
#include <cstdint>
#include <unordered_map>

namespace placegraph {

/// The surface of a TSDF, cube by cube, with vertices that cubes share.
class TsdfSurface {
 public:
  /// The volume must outlive the object.
  explicit TsdfSurface(const TsdfVolume& volume) : volume_(volume) {}

  /// Adds the triangles between eight voxels, of which this is the one with the least coordinates.
  void add_cube(const VoxelIndex& index);
  /// The mesh, with the mean normals of the triangles around each vertex.
  TriangleMesh finish();

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

}  // namespace placegraph
