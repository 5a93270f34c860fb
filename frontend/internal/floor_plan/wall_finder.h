#pragma once
#include <placegraph/frontend/floor_plan/floor_plan_options.h>
#include <placegraph/frontend/internal/floor_plan/voxel_evidence.h>
#include <placegraph/frontend/internal/floor_plan/wall_piece.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/scene/indoor_map.h>

#include <vector>

namespace placegraph {

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
