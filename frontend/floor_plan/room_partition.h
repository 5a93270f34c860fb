#pragma once
#include <placegraph/frontend/floor_plan/door_finder.h>
#include <placegraph/graph/image/image.h>

namespace placegraph {

struct RoomPartitionOptions {
  double min_area_m2 = 2;
  double neck_m = 0.7;           ///< free space narrower than this parts rooms
  double closing_m = 0.15;       ///< unseen cells so near to free ones are free
  double completed_share = 0.5;  ///< of a box between walls that is seen free: all of it is
  double walled_share = 0.2;  ///< of an unseen part's border: with more, it is no part of the room
  double outline_m = 0.08;    ///< tolerance of a room's outline
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, RoomPartitionOptions& options);

/// Rooms in the frame of the walls.
struct RoomPartition {
  /// CV_32SC1 over the columns and rows of the voxels: 1 + room, 0 none.
  Image room_of_cell;
  struct Room {
    std::vector<Eigen::Vector2d> outline;
    std::vector<std::vector<Eigen::Vector2d>> holes;
    double area_m2 = 0, width_m = 0;  ///< twice the largest distance from its border
  };
  std::vector<Room> rooms;
};

/// The free space (cells that rays pass at any height) parted at walls, at doors, and where it is
/// narrower than a neck; what lies unseen between cells of a room that the path enters, as
/// furniture hides it, belongs to the room unless walls take much of its border.
[[nodiscard]] RoomPartition partition_rooms(const VoxelEvidence& voxels,
                                            const std::vector<WallPiece>& walls,
                                            const std::vector<DoorPiece>& doors,
                                            const std::vector<Eigen::Vector3d>& path,
                                            const RoomPartitionOptions& options = {});

}  // namespace placegraph
