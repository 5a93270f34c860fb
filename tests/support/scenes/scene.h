#pragma once
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/measurements/landmark.h>

#include <vector>

#include "tests/support/scenes/poses.h"

namespace placegraph::test {

/// An undistorted camera with its principal point off the middle.
inline Camera pinhole(int width, int height, double focal_px) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.fx = focal_px;
  camera.fy = 1.02 * focal_px;
  camera.cx = 0.5 * width - 3.3;
  camera.cy = 0.5 * height + 2.1;
  return camera;
}

/// Angle between two directions.
inline double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Points that several cameras see, and where: px[view][point], exact.
struct PointScene {
  Camera camera;
  std::vector<SE3> T_ref_cam;
  std::vector<Eigen::Vector3d> points_ref;
  std::vector<std::vector<Eigen::Vector2d>> px;
};

/// `count` points in the sight of all cameras; the first camera's pixels are spread evenly, and
/// `depth_m(ray)` says how far along the first camera's ray (z = 1) the point lies.
template <class Depth>
PointScene make_scene(const Camera& camera, const std::vector<SE3>& T_ref_cam, int count,
                      Random& random, Depth&& depth_m) {
  PointScene scene{camera, T_ref_cam, {}, {}};
  scene.px.resize(T_ref_cam.size());
  for (int trial = 0; trial < 100 * count && static_cast<int>(scene.points_ref.size()) < count;
       ++trial) {
    const Eigen::Vector2d first(random.uniform(5, camera.width - 6),
                                random.uniform(5, camera.height - 6));
    const Eigen::Vector3d ray = *camera.unproject(first);
    const Eigen::Vector3d point = T_ref_cam[0] * Eigen::Vector3d(depth_m(ray) * ray);
    std::vector<Eigen::Vector2d> seen;
    for (const SE3& T : T_ref_cam)
      if (const auto px = camera.project(T.inverse() * point); px && camera.contains(*px))
        seen.push_back(*px);
    if (seen.size() < T_ref_cam.size()) continue;
    scene.points_ref.push_back(point);
    for (std::size_t view = 0; view < seen.size(); ++view) scene.px[view].push_back(seen[view]);
  }
  return scene;
}

/// Depths uniform in [near_m, far_m].
inline PointScene make_scene(const Camera& camera, const std::vector<SE3>& T_ref_cam, int count,
                             Random& random, double near_m = 4, double far_m = 15) {
  return make_scene(camera, T_ref_cam, count, random,
                    [&](const Eigen::Vector3d&) { return random.uniform(near_m, far_m); });
}

/// Depth along a ray (z = 1) to the plane n^T X = d.
inline auto on_plane(const Eigen::Vector3d& normal, double distance_m) {
  return [=](const Eigen::Vector3d& ray) { return distance_m / normal.normalized().dot(ray); };
}

inline void add_noise(std::vector<Eigen::Vector2d>& px, double sigma_px, Random& random) {
  for (Eigen::Vector2d& p : px) {
    p[0] += random.normal(0, sigma_px);
    p[1] += random.normal(0, sigma_px);
  }
}

/// Every `period`-th pixel goes to a random place of the image, far from where it was; returns how
/// many.
inline int spoil(const Camera& camera, std::vector<Eigen::Vector2d>& px, int first, int period,
                 Random& random) {
  int count = 0;
  for (std::size_t i = static_cast<std::size_t>(first); i < px.size();
       i += static_cast<std::size_t>(period), ++count) {
    Eigen::Vector2d elsewhere;
    do {
      elsewhere = {random.uniform(0, camera.width), random.uniform(0, camera.height)};
    } while ((elsewhere - px[i]).norm() < 30);
    px[i] = elsewhere;
  }
  return count;
}

inline BinaryDescriptor random_descriptor(Random& random) {
  BinaryDescriptor d;
  for (auto& word : d) {
    word = static_cast<std::uint64_t>(random.next()) << 32;
    word |= random.next();
  }
  return d;
}

/// The descriptor with `bits` different ones turned over.
inline BinaryDescriptor flipped(BinaryDescriptor d, int bits, Random& random) {
  std::vector<int> which;
  random.sample(256, bits, which);
  for (const int bit : which)
    d[static_cast<std::size_t>(bit / 64)] ^= std::uint64_t{1} << (bit % 64);
  return d;
}

}  // namespace placegraph::test
