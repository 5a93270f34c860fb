#include <placegraph/pipeline/dense/voxel_cloud.h>

#include <algorithm>

namespace placegraph {

VoxelCloud::VoxelCloud(double side, std::size_t most_bytes) : grid_(side) {
  constexpr std::size_t kNodeBytes = 32;  // memory of a link and of a bucket of the table
  most_voxels_ = most_bytes / (sizeof(Voxel) + sizeof(VoxelIndex) + kNodeBytes);
}

void VoxelCloud::add(const KeyframeDepth& depth) {
  const Camera& camera = depth.camera;
  const Eigen::Matrix3d R = depth.T_map_cam.rotation().matrix();
  for (int v = 0; v < depth.depth.rows; ++v)
    for (int u = 0; u < depth.depth.cols; ++u) {
      const double z = depth.depth.at<float>(v, u);
      if (!(z > 0)) continue;
      const Eigen::Vector3d p =
          depth.T_map_cam *
          Eigen::Vector3d(z * (u - camera.cx) / camera.fx, z * (v - camera.cy) / camera.fy, z);
      const auto& normal = depth.normal.at<cv::Vec3f>(v, u);
      const auto& bgr = depth.colour.at<cv::Vec3b>(v, u);
      const double sigma = depth.sigma_inverse.at<float>(v, u) * z * z / grid_.side();
      const auto weight = static_cast<float>(1 / (sigma * sigma + 1e-6));
      const VoxelIndex index = grid_.at(p);
      Voxel& voxel = voxels_[index];
      voxel.position += weight * (p - grid_.corner(index)).cast<float>();
      voxel.normal += weight * (R * Eigen::Vector3d(normal[0], normal[1], normal[2])).cast<float>();
      voxel.rgb += weight * Eigen::Vector3f(bgr[2], bgr[1], bgr[0]);
      voxel.weight += weight;
      ++voxel.pixels;
    }
  require(voxels_.size() <= most_voxels_,
          "voxels: they are too small for the memory; give larger ones with --voxel");
}

std::vector<DensePoint> VoxelCloud::points(int least_pixels) const {
  std::vector<VoxelIndex> order;
  for (const auto& [index, voxel] : voxels_)
    if (voxel.pixels >= least_pixels) order.push_back(index);
  std::ranges::sort(order);
  std::vector<DensePoint> points;
  points.reserve(order.size());
  for (const VoxelIndex& index : order) {
    const Voxel& voxel = voxels_.at(index);
    const float size = voxel.normal.norm();
    if (!(size > 0)) continue;
    DensePoint& point = points.emplace_back();
    point.position = grid_.corner(index) + (voxel.position / voxel.weight).cast<double>();
    point.normal = voxel.normal / size;
    for (int i = 0; i < 3; ++i)
      point.rgb[static_cast<std::size_t>(i)] =
          static_cast<std::uint8_t>(std::lround(voxel.rgb[i] / voxel.weight));
    point.pixels = voxel.pixels;
  }
  return points;
}

}  // namespace placegraph
