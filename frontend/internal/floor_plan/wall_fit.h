#pragma once
#include <placegraph/frontend/internal/floor_plan/wall_piece.h>

#include <vector>

namespace placegraph {

/// What still counts as one wall.
struct WallTolerance {
  double band_m;            ///< half width of what counts as one plane
  double max_rotation_deg;  ///< of a wall from the axis that it runs along
  double max_gap_m;         ///< within a wall
  double max_step_m;        ///< between pieces of one wall: what drift of the poses makes of it
};

/// Fits a piece of wall to the points near it: the line through them (reweighted least squares,
/// Cauchy), which slopes only where the piece is long, and what they tell of its extent, its height
/// and the sights that it is from. `points` face the piece's side. False, the piece then being of
/// no use, if there are too few points or the wall turns more than `max_rotation_deg`.
[[nodiscard]] bool fit_wall(const std::vector<const PlacedPoint*>& points,
                            const WallTolerance& tolerance, WallPiece& piece);

/// Joins pieces of one side that are one wall which poses of different rounds have put a little
/// apart, each fitted anew to `points`.
void join_walls(const std::vector<const PlacedPoint*>& points, const WallTolerance& tolerance,
                std::vector<WallPiece>& pieces);

}  // namespace placegraph
