#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace placegraph {

/// Counts of rays that ended in the cells of a block of space, and of rays that passed through.
///
/// The frame has z up.
class VoxelEvidence {
 public:
  /// Makes cells of `cell_m` (larger if the block would need more than `most_cells`) and `layer_m`
  /// high.
  VoxelEvidence(const Eigen::Vector3d& low, const Eigen::Vector3d& high, double cell_m,
                double layer_m, std::size_t most_cells = 60000000);

  /// Adds an observed ray from one point to another: cells along it are passed, except for the last
  /// `short_m`; the last one is hit, unless `hit` is false.
  void add_ray(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double short_m, bool hit);

  int columns() const { return size_[0]; }
  int rows() const { return size_[1]; }
  int layers() const { return size_[2]; }
  double cell_m() const { return cell_; }
  double layer_m() const { return layer_; }
  const Eigen::Vector3d& low() const { return low_; }
  int column_of(double x) const { return static_cast<int>(std::floor((x - low_[0]) / cell_)); }
  int row_of(double y) const { return static_cast<int>(std::floor((y - low_[1]) / cell_)); }
  int layer_of(double z) const { return static_cast<int>(std::floor((z - low_[2]) / layer_)); }
  int passes(int column, int row, int layer) const { return passes_[index(column, row, layer)]; }
  int hits(int column, int row, int layer) const { return hits_[index(column, row, layer)]; }
  bool contains(int column, int row) const {
    return column >= 0 && row >= 0 && column < size_[0] && row < size_[1];
  }

 private:
  std::size_t index(int column, int row, int layer) const {
    return (static_cast<std::size_t>(row) * size_[0] + column) * size_[2] + layer;
  }
  Eigen::Vector3d low_;
  double cell_, layer_;
  Eigen::Vector3i size_;
  std::vector<std::uint8_t> passes_, hits_;  ///< counts up to 255
};

}  // namespace placegraph
