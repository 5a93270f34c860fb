#pragma once
#include <placegraph/frontend/floor_plan/floor_plan_options.h>
#include <placegraph/frontend/floor_plan/wall_finder.h>
#include <placegraph/frontend/floor_plan/wall_profile.h>
#include <placegraph/graph/core/options.h>

#include <vector>

namespace placegraph {

/// Door in the frame of the walls: in the wall surface `offset_m` along `axis`.
struct DoorPiece {
  int axis = 0, sign = 1;
  double offset_m = 0, from_m = 0, to_m = 0;
  double head_m = 0;  ///< height of the head; 0: not visible
  bool closed = false;
};

/// Doors of one wall's plane.
struct ProfileDoors {
  std::vector<DoorPiece> between_walls;  ///< doors with wall at both sides
  std::vector<DoorPiece> half_seen;      ///< doors with one jamb, where the camera went through
};
/// Finds at most one door in every stretch of the profile without wall at the height of doors; see
/// find_doors.
[[nodiscard]] ProfileDoors doors_of(const WallProfile& profile, const DoorFinderOptions& options);

/// Finds doors along each wall's surface, and in gaps between walls of one plane.
///
/// Open doors: there is no surface below a head and rays pass, or, without a head, the `path`
/// (camera positions, in order) goes through a gap of a door's width. Where the path goes through,
/// one jamb is enough if the gap ends within 1.4 m, where rays that come so far are stopped for 0.4
/// m. Closed doors: a leaf of a door's height and width, set back from a wall that continues above
/// or beside it. If the wall beside is first visible 0.4 m farther on or more, a door ends at the
/// end of its passage or leaf. A door that is visible from both sides is returned once.
[[nodiscard]] std::vector<DoorPiece> find_doors(const std::vector<WallPiece>& walls,
                                                const std::vector<PlacedPoint>& points,
                                                const VoxelEvidence& voxels,
                                                const std::vector<Eigen::Vector3d>& path,
                                                const DoorFinderOptions& options = {});

}  // namespace placegraph
