#pragma once
#include <Eigen/Core>

namespace placegraph {

/// Surface point in the frame of the walls (x, y along their normals, z up, floor 0).
struct PlacedPoint {
  Eigen::Vector3f point, normal;
  float sigma = 0;
  int observation = 0;  ///< number of the observation (image) that it is from
};

/// Wall in the frame of the walls: the points of coordinate `offset_m` along `axis`, visible from
/// the side of `sign`, between `from_m` and `to_m` along the other axis.
struct WallPiece {
  int axis = 0, sign = 1;
  double offset_m = 0, from_m = 0, to_m = 0;
  double slope = 0;  ///< change of the offset along the wall; `offset_m` is that of its middle
  double offset_at(double along_m) const {
    return offset_m + slope * (along_m - 0.5 * (from_m + to_m));
  }
  double sigma_m = 0, low_m = 0, high_m = 0;
  int count = 0, observation = 0;  ///< number of points, and the observation with most of them
};

}  // namespace placegraph
