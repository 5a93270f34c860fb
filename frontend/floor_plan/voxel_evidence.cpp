#include <placegraph/frontend/floor_plan/voxel_evidence.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {

VoxelEvidence::VoxelEvidence(const Eigen::Vector3d& low, const Eigen::Vector3d& high, double cell_m,
                             double layer_m, std::size_t most_cells)
    : low_(low), cell_(cell_m), layer_(layer_m) {
  const auto cells = [&] {
    const Eigen::Vector3d extent = (high - low).cwiseMax(Eigen::Vector3d::Constant(layer_m));
    return std::ceil(extent[0] / cell_) * std::ceil(extent[1] / cell_) *
           std::ceil(extent[2] / layer_);
  };
  while (cells() > static_cast<double>(most_cells)) cell_ *= 1.25;
  const Eigen::Vector3d extent = (high - low).cwiseMax(Eigen::Vector3d::Constant(layer_m));
  size_ = {static_cast<int>(std::ceil(extent[0] / cell_)) + 1,
           static_cast<int>(std::ceil(extent[1] / cell_)) + 1,
           static_cast<int>(std::ceil(extent[2] / layer_)) + 1};
  passes_.assign(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2], 0);
  hits_ = passes_;
}

void VoxelEvidence::add_ray(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double short_m,
                            bool hit) {
  const Eigen::Vector3d ray = to - from;
  const double length = ray.norm();
  const auto cell_of = [&](const Eigen::Vector3d& p, std::size_t& cell) {
    const int c = column_of(p[0]), r = row_of(p[1]), l = layer_of(p[2]);
    if (!contains(c, r) || l < 0 || l >= size_[2]) return false;
    cell = index(c, r, l);
    return true;
  };
  const auto count = [](std::uint8_t& value) {
    if (value < 255) ++value;
  };
  std::size_t cell = 0, last = std::numeric_limits<std::size_t>::max();
  const int steps = static_cast<int>(std::max(0.0, length - short_m) / cell_);
  for (int k = 0; k < steps; ++k) {
    if (!cell_of(from + (k * cell_ / length) * ray, cell) || cell == last) continue;
    count(passes_[cell]);
    last = cell;
  }
  if (hit && cell_of(to, cell)) count(hits_[cell]);
}

}  // namespace placegraph
