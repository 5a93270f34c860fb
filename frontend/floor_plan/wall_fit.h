#pragma once
#include <Eigen/Core>
#include <vector>

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

/// Tolerances of points and pieces of one wall.
struct WallTolerance {
  double band_m;            ///< half the thickness of a set of points that counts as one plane
  double max_rotation_deg;  ///< maximum angle of a wall from the axis that it runs along
  double max_gap_m;         ///< longest gap within a wall
  double max_step_m;  ///< maximum offset between pieces of one wall, caused by drift of the poses
};

/// Fits a piece of wall to the points near it.
///
/// The line through them (reweighted least squares, Cauchy) slopes only for a long piece; the
/// points also determine its extent, its height and its observation. `points` face the piece's
/// side. Returns false, and the piece is not usable, if there are too few points or the wall's
/// angle is larger than `max_rotation_deg`.
[[nodiscard]] bool fit_wall(const std::vector<const PlacedPoint*>& points,
                            const WallTolerance& tolerance, WallPiece& piece);

/// Joins pieces of one side that are one wall with an offset by drift between visits; each joined
/// piece is fitted again to `points`.
void join_walls(const std::vector<const PlacedPoint*>& points, const WallTolerance& tolerance,
                std::vector<WallPiece>& pieces);

}  // namespace placegraph
