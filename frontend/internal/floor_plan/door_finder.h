#pragma once
#include <placegraph/frontend/floor_plan/floor_plan_options.h>
#include <placegraph/frontend/internal/floor_plan/wall_finder.h>
#include <placegraph/frontend/internal/floor_plan/wall_profile.h>
#include <placegraph/graph/core/options.h>

#include <vector>

namespace placegraph {

/// A door in the frame of the walls: in the wall surface `offset_m` along `axis`.
struct DoorPiece {
  int axis = 0, sign = 1;
  double offset_m = 0, from_m = 0, to_m = 0;
  double head_m = 0;  ///< 0: none was seen
  bool closed = false;
};

/// Doors of one wall's plane.
struct ProfileDoors {
  std::vector<DoorPiece> between_walls;  ///< with wall at both sides
  std::vector<DoorPiece> half_seen;      ///< with one jamb, where the camera went through
};
/// Every stretch of the profile without wall at the height of doors is one, or none; see
/// find_doors.
[[nodiscard]] ProfileDoors doors_of(const WallProfile& profile, const DoorFinderOptions& options);

/// Doors along each wall's surface, and what lies between walls of one plane. Open ones: below a
/// head nothing stands and rays pass, or, without a head, the `path` (camera positions, in order)
/// goes through a gap of a door's width. Where the path goes through, one jamb is enough if the gap
/// ends within 1.4 m, where rays that come so far are stopped for 0.4 m. Closed ones: a leaf as
/// high and wide as doors are, set back from a wall that goes on above or beside it. Where the wall
/// beside is seen only 0.4 m farther on or more, a door ends where its passage or leaf does. A door
/// that both sides tell is told once.
[[nodiscard]] std::vector<DoorPiece> find_doors(const std::vector<WallPiece>& walls,
                                                const std::vector<PlacedPoint>& points,
                                                const VoxelEvidence& voxels,
                                                const std::vector<Eigen::Vector3d>& path,
                                                const DoorFinderOptions& options = {});

}  // namespace placegraph
