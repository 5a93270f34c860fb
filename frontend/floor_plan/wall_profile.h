#pragma once
#include <placegraph/frontend/floor_plan/voxel_evidence.h>
#include <placegraph/frontend/floor_plan/wall_fit.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Plane that contains pieces of wall, in the frame of the walls: one side, offsets that agree.
struct WallPlane {
  int axis = 0, sign = 1;
  double offset_m = 0, from_m = 0, to_m = 0;
};

/// Groups pieces into planes, the longest piece first; pieces farther apart than `reach_m` are not
/// joined.
[[nodiscard]] std::vector<WallPlane> planes_of(const std::vector<WallPiece>& walls, double reach_m);

/// Evidence at one step along a wall's surface at the height of doors.
struct WallStep {
  bool wall = false;           ///< the surface continues at this height
  bool recess = false;         ///< there is a surface a little behind it
  bool open = false;           ///< rays pass
  bool faced = false;          ///< rays pass in front of it
  bool over = false;           ///< rays pass above the height of a head
  std::optional<double> head;  ///< lowest height of the surface above a door's [m]
  /// Distance of the nearby surface behind the plane: drift of the poses bends it.
  double behind_m = 0;
};

/// Surface of a wall's plane step by step, extended by a door's width beyond its ends.
struct WallProfile {
  // A cell of the plan. Chosen.
  static constexpr double kStep_m = 0.05;
  WallPlane plane;
  double from_m = 0;  ///< position along the wall where the first step begins
  std::vector<WallStep> steps{};
  std::vector<double> crossed_m{};  ///< positions where the camera went through the plane

  /// Position where a step begins.
  double at_m(std::size_t step) const { return from_m + static_cast<double>(step) * kStep_m; }
  /// Whether the camera went through the steps from `begin` to before `end`.
  bool crossed(std::size_t begin, std::size_t end) const;
};

/// Limits for the shape of doors.
struct DoorShape {
  double max_width_m;
  double min_head_m;                  ///< height of an opening's head above the floor
  double min_recess_m, max_recess_m;  ///< depth of a leaf behind its wall's surface
};

/// Computes the profile of a plane from points, rays and the `path` (camera positions, in order).
[[nodiscard]] WallProfile profile_wall(const WallPlane& plane,
                                       const std::vector<PlacedPoint>& points,
                                       const VoxelEvidence& voxels,
                                       const std::vector<Eigen::Vector3d>& path,
                                       const DoorShape& door);

}  // namespace placegraph
