#pragma once
#include <placegraph/frontend/floor_plan/wall_piece.h>

#include <vector>

namespace placegraph {

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
