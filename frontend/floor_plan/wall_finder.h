#pragma once
#include <placegraph/frontend/floor_plan/floor_plan_options.h>
#include <placegraph/frontend/floor_plan/voxel_evidence.h>
#include <placegraph/frontend/floor_plan/wall_fit.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/scene/floor_plan.h>

#include <vector>

namespace placegraph {

/// Minimum length of a wall. Chosen.
inline constexpr double kMinWallLength_m = 0.4;

/// Finds upright planes orthogonal to the axes that are covered over their height.
///
/// No ray passes through them or above them: furniture ends below the ceiling, and surfaces behind
/// it are visible. For each of the four sides, planes are selected in the order of their area of
/// wall, each with the points near it.
[[nodiscard]] std::vector<WallPiece> find_walls(const std::vector<PlacedPoint>& points,
                                                const VoxelEvidence& voxels,
                                                const WallFinderOptions& options = {});

/// Removes walls where the camera went: `reach_m` to both sides of every crossing is cut out of the
/// walls; remaining parts shorter than `min_length_m` are dropped, too.
[[nodiscard]] std::vector<WallPiece> cut_at_path(const std::vector<WallPiece>& walls,
                                                 const std::vector<Eigen::Vector3d>& path,
                                                 double reach_m, double min_length_m);

}  // namespace placegraph
