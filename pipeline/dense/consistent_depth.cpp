#include <placegraph/pipeline/dense/consistent_depth.h>
#include <placegraph/pipeline/dense/depth_cleaning.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace placegraph {
namespace {

/// What other keyframes say about the depth of a pixel.
struct DepthVotes {
  int agreeing = 0, seeing_through = 0;
  double sum = 0, weights = 0;  ///< sums over the inverse depths that agree
};

/// Adds the vote of another keyframe on a point.
void vote(const KeyframeDepth& other, const SE3& T_other_cam, const SE3& T_cam_other,
          const Eigen::Vector3d& p_cam, double sigma, const ConsistencyOptions& options,
          DepthVotes& votes) {
  const Eigen::Vector3d p = T_other_cam * p_cam;
  if (!(p[2] > 0)) return;
  const Camera& camera = other.camera;
  const int u = static_cast<int>(std::lround(camera.fx * p[0] / p[2] + camera.cx));
  const int v = static_cast<int>(std::lround(camera.fy * p[1] / p[2] + camera.cy));
  if (u < 0 || v < 0 || u >= camera.width || v >= camera.height) return;
  const double z = other.depth.at<float>(v, u);
  if (!(z > 0)) return;
  const double other_sigma = other.sigma_inverse.at<float>(v, u);
  const double limit =
      options.sigmas * std::hypot(sigma, other_sigma) + options.pose_share / std::min(p[2], z);
  const double difference = 1 / p[2] - 1 / z;
  if (std::abs(difference) > limit) {
    votes.seeing_through += difference > 0;
    return;
  }
  const Eigen::Vector3d seen = T_cam_other * Eigen::Vector3d(z / p[2] * p);
  if (!(seen[2] > 0)) return;
  ++votes.agreeing;
  const double weight = 1 / (other_sigma * other_sigma);
  votes.sum += weight / seen[2];
  votes.weights += weight;
}

}  // namespace

const KeyframeDepth& ConsistentDepth::cleaned(std::size_t index) {
  for (const auto& [number, depth] : read_)
    if (number == index) return depth;
  KeyframeDepth& depth = read_.emplace_back(index, source_->of(index)).second;
  limit_uncertainty(depth, options_.most_sigma);
  remove_edges(depth, options_.bend);
  return depth;
}

KeyframeDepth ConsistentDepth::of(std::size_t index) {
  const std::size_t first = index - std::min(index, options_.reach);
  const std::size_t last = std::min(index + options_.reach, size() - 1);
  std::erase_if(read_, [&](const auto& one) { return one.first < first || one.first > last; });
  for (std::size_t i = first; i <= last; ++i) cleaned(i);
  KeyframeDepth result = cleaned(index);
  result.depth = result.depth.clone();

  struct Other {
    const KeyframeDepth* depth;
    SE3 T_other_cam, T_cam_other;
  };
  std::vector<Other> others;
  for (const auto& [number, depth] : read_) {
    if (number == index) continue;
    const SE3 T = depth.T_map_cam.inverse() * result.T_map_cam;
    others.push_back({&depth, T, T.inverse()});
  }
  const Camera& camera = result.camera;
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      float& z = result.depth.at<float>(v, u);
      if (!(z > 0)) continue;
      const double sigma = result.sigma_inverse.at<float>(v, u);
      const Eigen::Vector3d p(z * (u - camera.cx) / camera.fx, z * (v - camera.cy) / camera.fy, z);
      DepthVotes votes{0, 0, 1 / (sigma * sigma) / z, 1 / (sigma * sigma)};
      for (const Other& other : others)
        vote(*other.depth, other.T_other_cam, other.T_cam_other, p, sigma, options_, votes);
      const bool kept =
          votes.agreeing >= options_.least_agreeing && votes.agreeing > votes.seeing_through;
      z = kept ? static_cast<float>(votes.weights / votes.sum) : 0;
    }
  estimate_normals(result, options_.radius_px, options_.least_cosine);
  return result;
}

}  // namespace placegraph
