#include <placegraph/pipeline/dense/tsdf_volume.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// The position of a block's voxel in the block.
std::size_t in_block(int x, int y, int z) {
  return static_cast<std::size_t>((z * TsdfVolume::kBlock + y) * TsdfVolume::kBlock + x);
}

/// The block of a voxel along one axis.
std::int32_t block_of(std::int32_t voxel) {
  constexpr std::int32_t kSide = TsdfVolume::kBlock;
  return voxel >= 0 ? voxel / kSide : -((-voxel + kSide - 1) / kSide);
}

void blend(TsdfVoxel& voxel, float distance, float weight, const cv::Vec3b& bgr) {
  const float sum = voxel.weight + weight, share = weight / sum;
  voxel.distance += share * (distance - voxel.distance);
  for (int i = 0; i < 3; ++i) {
    std::uint8_t& value = voxel.rgb[static_cast<std::size_t>(i)];
    value = static_cast<std::uint8_t>(
        std::lround(static_cast<float>(value) +
                    share * (static_cast<float>(bgr[2 - i]) - static_cast<float>(value))));
  }
  voxel.weight = sum;
}

}  // namespace

TsdfVolume::TsdfVolume(double side, std::size_t most_bytes)
    : grid_(side), block_grid_(kBlock * side), most_blocks_(most_bytes / sizeof(Block)) {}

std::vector<VoxelIndex> TsdfVolume::blocks_near(const KeyframeDepth& depth) const {
  const Camera& camera = depth.camera;
  std::vector<VoxelIndex> near;
  VoxelIndex last{};
  for (int v = 0; v < depth.depth.rows; ++v)
    for (int u = 0; u < depth.depth.cols; ++u) {
      const double z = depth.depth.at<float>(v, u);
      if (!(z > 0)) continue;
      const Eigen::Vector3d ray((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
      const double reach = truncation() / ray.norm();
      for (const double at : {z - reach, z - 0.5 * reach, z, z + 0.5 * reach, z + reach}) {
        const VoxelIndex index = block_grid_.at(depth.T_map_cam * Eigen::Vector3d(at * ray));
        if (!near.empty() && index == last) continue;
        near.push_back(index);
        last = index;
      }
      if (near.size() > 4'000'000) {  // blocks repeat in every row
        std::ranges::sort(near);
        near.erase(std::ranges::unique(near).begin(), near.end());
      }
    }
  std::ranges::sort(near);
  near.erase(std::ranges::unique(near).begin(), near.end());
  return near;
}

void TsdfVolume::add(const KeyframeDepth& depth) {
  for (const VoxelIndex& index : blocks_near(depth)) {
    std::unique_ptr<Block>& block = blocks_[index];
    if (!block) {
      require(blocks_.size() <= most_blocks_,
              "voxels: they are too small for the memory; give larger ones with --voxel");
      block = std::make_unique<Block>();
    }
    update(depth, index, *block);
  }
}

void TsdfVolume::update(const KeyframeDepth& depth, const VoxelIndex& index, Block& block) const {
  const Camera& camera = depth.camera;
  const SE3 T_cam_map = depth.T_map_cam.inverse();
  const Eigen::Matrix3d step = grid_.side() * T_cam_map.rotation().matrix();
  const Eigen::Vector3d corner = T_cam_map * block_grid_.corner(index);
  const double truncated = truncation();
  for (int z = 0; z < kBlock; ++z)
    for (int y = 0; y < kBlock; ++y)
      for (int x = 0; x < kBlock; ++x) {
        const Eigen::Vector3d p = corner + step * Eigen::Vector3d(x, y, z);
        if (!(p[2] > 0)) continue;
        const auto u = static_cast<int>(std::floor(camera.fx * p[0] / p[2] + camera.cx + 0.5));
        const auto v = static_cast<int>(std::floor(camera.fy * p[1] / p[2] + camera.cy + 0.5));
        if (u < 0 || v < 0 || u >= camera.width || v >= camera.height) continue;
        const double seen = depth.depth.at<float>(v, u);
        if (!(seen > 0)) continue;
        const auto& n = depth.normal.at<cv::Vec3f>(v, u);
        const Eigen::Vector3d surface(seen * (u - camera.cx) / camera.fx,
                                      seen * (v - camera.cy) / camera.fy, seen);
        const Eigen::Vector3d normal(n[0], n[1], n[2]);
        const double distance = normal.dot(p - surface);
        if (distance < -truncated) continue;
        const double sigma = depth.sigma_inverse.at<float>(v, u) * seen * seen / grid_.side();
        const double cosine = normal.dot(surface) / surface.norm();
        const auto weight = static_cast<float>(cosine * cosine / (sigma * sigma + 1e-6));
        blend(block[in_block(x, y, z)], static_cast<float>(std::min(distance, truncated)), weight,
              depth.colour.at<cv::Vec3b>(v, u));
      }
}

const TsdfVoxel* TsdfVolume::find(const VoxelIndex& index) const {
  const VoxelIndex of{block_of(index[0]), block_of(index[1]), block_of(index[2])};
  const auto block = blocks_.find(of);
  if (block == blocks_.end()) return nullptr;
  return &(*block->second)[in_block(index[0] - kBlock * of[0], index[1] - kBlock * of[1],
                                    index[2] - kBlock * of[2])];
}

std::vector<VoxelIndex> TsdfVolume::blocks() const {
  std::vector<VoxelIndex> order;
  for (const auto& [index, block] : blocks_) order.push_back(index);
  std::ranges::sort(order);
  return order;
}

}  // namespace placegraph
