#pragma once
#include <placegraph/frontend/internal/floor_plan/voxel_evidence.h>
#include <placegraph/frontend/internal/floor_plan/wall_piece.h>

#include <optional>
#include <vector>

namespace placegraph {

/// A plane that pieces of wall lie in, in the frame of the walls: one side, offsets that agree.
struct WallPlane {
  int axis = 0, sign = 1;
  double offset_m = 0, from_m = 0, to_m = 0;
};

/// The planes of the pieces, the longest piece first; pieces farther apart than `reach_m` are not
/// joined.
[[nodiscard]] std::vector<WallPlane> planes_of(const std::vector<WallPiece>& walls, double reach_m);

/// What one step along a wall's surface shows at the height of doors.
struct WallStep {
  bool wall = false;           ///< the surface goes on down there
  bool recess = false;         ///< something stands a little behind it
  bool open = false;           ///< rays pass
  bool faced = false;          ///< rays pass in front of it
  bool over = false;           ///< rays pass above where a head would be
  std::optional<double> head;  ///< lowest height of the surface above a door's [m]
  double behind_m = 0;         ///< of the surface about it from the plane: poses that drift bend it
};

/// The surface of a wall's plane step by step, as wide as a door beyond its ends.
struct WallProfile {
  static constexpr double kStep_m = 0.05;
  WallPlane plane;
  double from_m = 0;  ///< along the wall, where the first step begins
  std::vector<WallStep> steps{};
  std::vector<double> crossed_m{};  ///< where the camera went through the plane

  /// Where a step begins.
  double at_m(std::size_t step) const { return from_m + static_cast<double>(step) * kStep_m; }
  /// Whether the camera went through the steps from `begin` to before `end`.
  bool crossed(std::size_t begin, std::size_t end) const;
};

/// What doors may look like.
struct DoorShape {
  double max_width_m;
  double min_head_m;                  ///< of an opening's head above the floor
  double min_recess_m, max_recess_m;  ///< of a leaf behind its wall's surface
};

/// What points and rays tell of a plane, and the `path` (camera positions, in order).
[[nodiscard]] WallProfile profile_wall(const WallPlane& plane,
                                       const std::vector<PlacedPoint>& points,
                                       const VoxelEvidence& voxels,
                                       const std::vector<Eigen::Vector3d>& path,
                                       const DoorShape& door);

}  // namespace placegraph
