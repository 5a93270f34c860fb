#pragma once
#include <placegraph/frontend/internal/floor_plan/door_finder.h>
#include <placegraph/frontend/internal/floor_plan/room_partition.h>
#include <placegraph/frontend/internal/floor_plan/wall_finder.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map.h>
#include <placegraph/pipeline/internal/scene/plan_frame.h>

#include <cstdint>
#include <vector>

// The parts of an IndoorMap from what was found in the frame of the walls.
namespace placegraph {

/// What the walls, doors and rooms were found from, in the frame of the walls.
struct PlacedObservations {
  std::vector<KeyframeId> keyframes;  ///< by sight
  std::vector<Eigen::Vector3d> path;  ///< where the camera of each sight stood
  std::vector<PlacedPoint> points;
};

/// `map` tells the places that the keyframes belong to.
std::vector<IndoorWall> plan_walls(const std::vector<WallPiece>& walls, const PlanFrame& frame,
                                   const PlacedObservations& observations, const Map& map);

/// Rooms, of which those several times as long as wide are corridors; each with the places whose
/// anchor stands in it, whether the camera was in it, and its ceiling where that is seen.
std::vector<IndoorRoom> plan_rooms(const RoomPartition& rooms, const VoxelEvidence& voxels,
                                   const PlanFrame& frame, const PlacedObservations& observations,
                                   const Map& map);

/// Doors, each with the rooms on its two sides.
std::vector<IndoorDoor> plan_doors(const std::vector<DoorPiece>& doors, const RoomPartition& rooms,
                                   const VoxelEvidence& voxels, const PlanFrame& frame);

/// What stands between 0.2 and 2 m above the floor, in cells of twice the size of the voxels.
IndoorMap::Cells plan_cells(const VoxelEvidence& voxels);

}  // namespace placegraph
