#pragma once
#include <placegraph/pipeline/dense/keyframe_depth.h>
#include <placegraph/pipeline/dense/voxel_grid.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace placegraph {

/// A voxel of a TSDF, at the corner with the least coordinates of its cube.
struct TsdfVoxel {
  float distance = 0;                 ///< to the surface, positive before it, truncated
  float weight = 0;                   ///< 0: never seen
  std::array<std::uint8_t, 3> rgb{};  ///< red, green, blue
};

/// Truncated signed distances to the surfaces that depth images show (Curless and Levoy 1996, "A
/// volumetric method for building complex models from range images").
///
/// Voxels exist in blocks near surfaces alone (Niessner et al. 2013, "Real-time 3D reconstruction
/// at scale using voxel hashing"). The distance of a voxel is that to the plane of the pixel which
/// shows it, and is weighted by the information of the pixel's depth and the squared cosine between
/// ray and normal.
class TsdfVolume {
 public:
  static constexpr int kBlock = 8;  ///< voxels along the side of a block

  /// `side`: side of the voxels at the map's scale; distances are truncated at four of them.
  /// Throws ArgumentError unless it is positive.
  explicit TsdfVolume(double side, std::size_t most_bytes = kMostVoxelBytes);

  /// Adds a depth image with normals. Throws ArgumentError if the blocks need more memory than is
  /// allowed.
  void add(const KeyframeDepth& depth);
  /// Positions of the blocks in their grid, sorted.
  std::vector<VoxelIndex> blocks() const;
  /// The voxel at this position in the grid; null where there is none.
  const TsdfVoxel* find(const VoxelIndex& index) const;
  double side() const { return grid_.side(); }
  double truncation() const { return 4 * grid_.side(); }

 private:
  using Block = std::array<TsdfVoxel, kBlock * kBlock * kBlock>;

  std::vector<VoxelIndex> blocks_near(const KeyframeDepth& depth) const;
  void update(const KeyframeDepth& depth, const VoxelIndex& index, Block& block) const;

  VoxelGrid grid_, block_grid_;
  std::size_t most_blocks_;
  std::unordered_map<VoxelIndex, std::unique_ptr<Block>, VoxelIndexHash> blocks_;
};

}  // namespace placegraph
