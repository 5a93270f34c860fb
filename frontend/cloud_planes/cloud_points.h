#pragma once
#include <placegraph/frontend/cloud_planes/cloud_planes.h>
#include <placegraph/frontend/planes/plane_sums.h>
#include <placegraph/graph/measurements/point_cloud.h>

#include <vector>

namespace placegraph {

/// Cloud in the form that plane finders use: its points, with their noise and neighbours.
struct CloudPoints {
  FitModel model;
  CloudNoise noise;
  std::vector<Eigen::Vector3d> xyz;  ///< positions [m]
  std::vector<double> depth;         ///< z of a depth image, range of a scan, 0 otherwise [m]
  std::vector<FitPoint> fit;
  std::vector<int> source;    ///< index of each point in the cloud
  int width = 0, height = 0;  ///< size of an organised cloud
  std::vector<int> pixel;     ///< in an organised cloud: point of each pixel, or -1
  /// Start of the neighbours of each point, with one more entry at the end.
  std::vector<int> begin;
  std::vector<int> neighbours;

  int size() const { return static_cast<int>(xyz.size()); }
};

/// Prepares a cloud.
///
/// Depth images have neighbours by pixel, scans taken from the origin (with a single surface along
/// every ray) by direction, other clouds by distance. The noise is that of small patches, the least
/// noisy third of them, with the best fitting power of the depth; in images also the part that
/// remains in the means of blocks beyond chance. `flatness`: share of the depth; for a cloud
/// without viewpoint, share of half its extent. Throws ArgumentError if the sizes of an organised
/// cloud do not agree, or a depth is not positive.
CloudPoints prepare_cloud(const PointCloud& cloud, double flatness);

}  // namespace placegraph
