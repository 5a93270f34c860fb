#pragma once
#include <placegraph/frontend/floor_plan/door_finder.h>
#include <placegraph/frontend/floor_plan/floor_plan_options.h>
#include <placegraph/graph/image/image.h>

namespace placegraph {

/// Rooms in the frame of the walls.
struct RoomPartition {
  /// CV_32SC1 over the columns and rows of the voxels: 1 + room, 0 none.
  Image room_of_cell;
  struct Room {
    std::vector<Eigen::Vector2d> outline;
    std::vector<std::vector<Eigen::Vector2d>> holes;
    double area_m2 = 0, width_m = 0;  ///< the width is twice the largest distance from its border
  };
  std::vector<Room> rooms;
};

/// Partitions the free space (cells that rays pass at any height) into rooms.
///
/// It is divided at walls, at doors, and where it is narrower than a neck. An unseen part between
/// cells of a room that the path enters, e.g. hidden by furniture, belongs to the room unless walls
/// are much of its border.
[[nodiscard]] RoomPartition partition_rooms(const VoxelEvidence& voxels,
                                            const std::vector<WallPiece>& walls,
                                            const std::vector<DoorPiece>& doors,
                                            const std::vector<Eigen::Vector3d>& path,
                                            const RoomPartitionOptions& options = {});

}  // namespace placegraph
