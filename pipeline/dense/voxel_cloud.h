#pragma once
#include <placegraph/io/exports/surface_ply.h>
#include <placegraph/pipeline/dense/keyframe_depth.h>
#include <placegraph/pipeline/dense/voxel_grid.h>

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace placegraph {

/// A cloud of the surfaces that depth images show: one point in each voxel, the weighted mean of
/// what was seen there.
class VoxelCloud {
 public:
  /// `side`: side of the voxels at the map's scale. Throws ArgumentError unless it is positive.
  explicit VoxelCloud(double side, std::size_t most_bytes = kMostVoxelBytes);

  /// Adds every pixel with depth and normal, weighted by the information of its depth. Throws
  /// ArgumentError if the voxels need more memory than is allowed.
  void add(const KeyframeDepth& depth);
  std::size_t size() const { return voxels_.size(); }
  /// The points in the order of the voxels, without the voxels of less than `least_pixels` pixels.
  std::vector<DensePoint> points(int least_pixels) const;

 private:
  struct Voxel {
    Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< weighted sum from the voxel's corner
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();    ///< weighted sum
    Eigen::Vector3f rgb = Eigen::Vector3f::Zero();       ///< weighted sum
    float weight = 0;
    std::int32_t pixels = 0;
  };

  VoxelGrid grid_;
  std::size_t most_voxels_;
  std::unordered_map<VoxelIndex, Voxel, VoxelIndexHash> voxels_;
};

}  // namespace placegraph
