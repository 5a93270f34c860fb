#pragma once
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/measurements/point_cloud.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace placegraph::test {

/// A small depth camera.
inline Camera depth_camera() {
  return {.width = 128, .height = 96, .fx = 120, .fy = 120, .cx = 63.5, .cy = 47.5};
}

/// A cloud with what each of its points is on.
struct SeenCloud {
  PointCloud cloud;
  std::vector<int> labels;
};

/// What a ray (z = 1) sees: its depth, not positive where nothing, and a label.
struct Seen {
  double depth = 0;
  int label = 0;
};

/// The nearest of planes n^T X = d in front of a ray; labels from 1.
inline Seen see_planes(const Eigen::Vector3d& ray, const std::vector<Eigen::Vector4d>& planes) {
  Seen seen{std::numeric_limits<double>::infinity(), 0};
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const double depth = planes[k][3] / planes[k].head<3>().dot(ray);
    if (depth > 0 && depth < seen.depth) seen = {depth, static_cast<int>(k) + 1};
  }
  return seen;
}

/// A depth image of a scene, all lengths times `scale`; `noise` is a share of the depth.
inline SeenCloud look_at(const std::function<Seen(const Eigen::Vector3d&)>& scene, double scale = 1,
                         double noise = 0, std::uint64_t seed = 1) {
  const Camera camera = depth_camera();
  Random random(seed);
  SeenCloud result;
  result.cloud.width = camera.width, result.cloud.height = camera.height;
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector3d ray((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1);
      const Seen seen = scene(ray);
      const bool there = seen.depth > 0 && std::isfinite(seen.depth);
      result.cloud.points.push_back(
          there ? Eigen::Vector3d(ray * seen.depth * scale * (1 + random.normal(0, noise)))
                : Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
      result.labels.push_back(there ? seen.label : 0);
    }
  return result;
}

/// The inside of a box's corner, two to three metres away: floor and two walls.
inline Seen see_corner(const Eigen::Vector3d& ray) {
  return see_planes(ray, {{0, 1, 0, 0.8}, {0.6, 0, 0.8, 2.4}, {-0.8, 0, 0.6, 2.0}});
}

/// The points that are there, in no order of pixels.
inline SeenCloud unorganised(const SeenCloud& seen) {
  SeenCloud result;
  for (std::size_t i = 0; i < seen.labels.size(); ++i) {
    if (!seen.cloud.points[i].allFinite()) continue;
    result.cloud.points.push_back(seen.cloud.points[i]);
    result.labels.push_back(seen.labels[i]);
  }
  return result;
}

/// How many true regions a segmentation holds, each with `overlap` both ways.
inline int regions_found(const std::vector<int>& truth, const std::vector<int>& found,
                         double overlap = 0.9) {
  int right = 0;
  for (int t = 1; t < 50; ++t)
    for (int f = 1; f < 50; ++f) {
      int both = 0, of_truth = 0, of_found = 0;
      for (std::size_t i = 0; i < truth.size(); ++i) {
        of_truth += truth[i] == t, of_found += found[i] == f;
        both += truth[i] == t && found[i] == f;
      }
      if (of_truth == 0) break;
      right += both > overlap * of_truth && both > overlap * of_found;
    }
  return right;
}

}  // namespace placegraph::test
