#pragma once
#include <placegraph/pipeline/dense/depth_cleaning.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace placegraph::test {

/// A camera of 160 x 120 pixels.
inline Camera dense_camera() { return {160, 120, 150, 150, 79.5, 59.5}; }

/// The depth image of a surface: `depth_of` maps a ray in the map (origin, direction with a depth
/// of 1 in the camera) to its depth, 0 where there is none.
template <class DepthOf>
KeyframeDepth rendered_depth(const SE3& T_map_cam, double sigma_inverse, DepthOf depth_of) {
  KeyframeDepth result;
  result.camera = dense_camera();
  result.T_map_cam = T_map_cam;
  const cv::Size size(result.camera.width, result.camera.height);
  result.depth = Image(size, CV_32FC1, cv::Scalar(0));
  result.sigma_inverse = Image(size, CV_32FC1, cv::Scalar(sigma_inverse));
  result.colour = Image(size, CV_8UC3, cv::Scalar(10, 20, 30));
  for (int v = 0; v < size.height; ++v)
    for (int u = 0; u < size.width; ++u)
      result.depth.at<float>(v, u) = static_cast<float>(
          depth_of(T_map_cam.translation(),
                   T_map_cam.rotation() * *result.camera.unproject(Eigen::Vector2d(u, v))));
  return result;
}

/// The depth of the sphere of radius 1 around the origin.
inline double sphere_depth(const Eigen::Vector3d& centre, const Eigen::Vector3d& ray) {
  const double a = ray.squaredNorm(), b = centre.dot(ray), c = centre.squaredNorm() - 1;
  const double root = b * b - a * c;
  return root > 0 ? (-b - std::sqrt(root)) / a : 0;
}

/// The depth of the plane z = 2 of the map.
inline double plane_depth(const Eigen::Vector3d& centre, const Eigen::Vector3d& ray) {
  const double depth = (2 - centre[2]) / ray[2];
  return depth > 0 ? depth : 0;
}

/// Poses on a circle of radius 3 around the y axis, which look at the origin.
inline std::vector<SE3> poses_around(int count) {
  std::vector<SE3> poses;
  for (int i = 0; i < count; ++i) {
    const SO3 rotation = SO3::exp({0, 2 * M_PI * i / count, 0});
    poses.emplace_back(rotation, rotation * Eigen::Vector3d(0, 0, -3));
  }
  return poses;
}

/// Depth images that are given, as a source.
class GivenDepth final : public DepthOfKeyframe {
 public:
  explicit GivenDepth(std::vector<KeyframeDepth> depths) : depths_(std::move(depths)) {}
  std::size_t size() const override { return depths_.size(); }
  KeyframeDepth of(std::size_t index) override {
    ++reads;
    KeyframeDepth copy = depths_.at(index);
    copy.depth = copy.depth.clone();
    return copy;
  }
  int reads = 0;

 private:
  std::vector<KeyframeDepth> depths_;
};

}  // namespace placegraph::test
