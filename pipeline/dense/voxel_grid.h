#pragma once
#include <placegraph/graph/core/error.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace placegraph {

/// Largest memory of a cloud or volume.
inline constexpr std::size_t kMostVoxelBytes = std::size_t{3} << 30;

/// Position of a voxel, or of a block of them, in its grid.
using VoxelIndex = std::array<std::int32_t, 3>;

/// Hash of a position (Teschner et al. 2003, "Optimized spatial hashing").
struct VoxelIndexHash {
  std::size_t operator()(const VoxelIndex& index) const {
    return static_cast<std::size_t>(static_cast<std::uint32_t>(index[0])) * 73856093U ^
           static_cast<std::size_t>(static_cast<std::uint32_t>(index[1])) * 19349669U ^
           static_cast<std::size_t>(static_cast<std::uint32_t>(index[2])) * 83492791U;
  }
};

/// A grid of cubes with a corner at the origin.
class VoxelGrid {
 public:
  /// Throws ArgumentError unless the side is positive and finite.
  explicit VoxelGrid(double side) : side_(side) {
    require(std::isfinite(side) && side > 0, "voxels: the side must be positive");
  }
  double side() const { return side_; }
  /// The cube that contains a point. Throws ArgumentError for one that is too far away.
  VoxelIndex at(const Eigen::Vector3d& point) const {
    // Half the range of std::int32_t.
    constexpr double kFarthest = 1 << 30;
    VoxelIndex index{};
    for (int i = 0; i < 3; ++i) {
      const double cell = std::floor(point[i] / side_);
      require(std::abs(cell) < kFarthest, "voxels: they are too small for the extent of the map");
      index[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(cell);
    }
    return index;
  }
  /// The corner of a cube with the least coordinates.
  Eigen::Vector3d corner(const VoxelIndex& index) const {
    return side_ * Eigen::Vector3d(index[0], index[1], index[2]);
  }

 private:
  double side_;
};

}  // namespace placegraph
