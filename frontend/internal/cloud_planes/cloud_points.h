#pragma once
#include <placegraph/frontend/internal/planes/plane_sums.h>
#include <placegraph/graph/internal/measurements/point_cloud.h>

#include <vector>

namespace placegraph {

/// Deviation of a point: `at_1m` times depth to the `power` [m]: 0 constant, 1 a share of the depth
/// (laser), 2 a constant disparity (stereo, depth cameras).
struct CloudNoise {
  double at_1m = 0;
  int power = 1;
  double least_m = 0;  ///< by the steps of the depths
  double shared = 0;   ///< of an image: variance that neighbours have in common, over theirs
  double sigma(double depth_m) const;
};

/// A cloud as plane finders take it: the points that are there, with their noise and neighbours.
struct CloudPoints {
  FitModel model;
  CloudNoise noise;
  std::vector<Eigen::Vector3d> xyz;  ///< [m]
  std::vector<double> depth;         ///< z of a depth image, range of a scan, 0 otherwise [m]
  std::vector<FitPoint> fit;
  std::vector<int> source;    ///< of each point, its number in the cloud
  int width = 0, height = 0;  ///< of an organised cloud
  std::vector<int> pixel;     ///< of an organised cloud: point of each pixel, or -1
  std::vector<int> begin;     ///< of the neighbours of each point, one more at the end
  std::vector<int> neighbours;

  int size() const { return static_cast<int>(xyz.size()); }
};

/// Prepares a cloud. Depth images have neighbours by pixel; scans that were taken from the origin
/// (the surface is single along every ray) by direction; other clouds by distance. The noise is
/// that of small patches, the quietest third of them, with the power of the depth that suits
/// best; in images also what the means of blocks keep of it beyond chance. `flatness`: of the
/// depth; of a cloud without viewpoint, of half its extent. Throws ArgumentError if the sizes of an
/// organised cloud do not fit, or a depth is not positive.
CloudPoints prepare_cloud(const PointCloud& cloud, double flatness);

}  // namespace placegraph
