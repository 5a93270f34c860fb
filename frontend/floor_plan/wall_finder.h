#pragma once
#include <placegraph/frontend/floor_plan/voxel_evidence.h>
#include <placegraph/frontend/floor_plan/wall_piece.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/scene/indoor_map.h>

#include <vector>

namespace placegraph {

struct WallFinderOptions {
  double max_sigma_m = 0.12;  ///< of points that walls are found from
  double max_turn_deg = 15;   ///< of a point's normal from the wall's
  double band_m = 0.05;       ///< half width of what counts as one plane
  double min_height_m = 0.8;  ///< that must be seen of a wall, one part above the other
  double min_share = 0.6;     ///< of the looked at height that must be wall
  double max_gap_m = 0.3;     ///< within a wall
  double min_length_m = 0.4;
  double max_step_m = 0.07;  ///< between pieces of one wall: what drift of the poses makes of it
  double min_top_m =
      2.3;  ///< of what is shorter than a door is high: leaves and furniture end below
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, WallFinderOptions& options);

/// Upright planes square to the axes that are covered over their height and that nothing is seen
/// through or over: furniture ends below the ceiling, and what stands behind it is seen. For each
/// of the four sides, planes are taken by how much wall they hold, each with the points near it.
[[nodiscard]] std::vector<WallPiece> find_walls(const std::vector<PlacedPoint>& points,
                                                const VoxelEvidence& voxels,
                                                const WallFinderOptions& options = {});

/// Where the camera went there is no wall: takes `reach_m` to both sides of every crossing out of
/// the walls; what is left of one and shorter than `min_length_m` too.
[[nodiscard]] std::vector<WallPiece> cut_at_path(const std::vector<WallPiece>& walls,
                                                 const std::vector<Eigen::Vector3d>& path,
                                                 double reach_m, double min_length_m);

}  // namespace placegraph
