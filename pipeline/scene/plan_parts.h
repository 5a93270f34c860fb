#pragma once
#include <placegraph/frontend/floor_plan/door_finder.h>
#include <placegraph/frontend/floor_plan/room_partition.h>
#include <placegraph/frontend/floor_plan/wall_finder.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map.h>
#include <placegraph/pipeline/scene/plan_frame.h>

#include <cstdint>
#include <vector>

// Builds the components of an FloorPlan from the detections in the frame of the walls.
namespace placegraph {

/// Observations from which walls, doors and rooms were detected, in the frame of the walls.
struct PlacedObservations {
  std::vector<KeyframeId> keyframes;  ///< keyframe of each observation
  std::vector<Eigen::Vector3d> path;  ///< camera position of each observation
  std::vector<PlacedPoint> points;
};

/// Walls of the plan; `map` provides the places of the keyframes.
std::vector<PlanWall> plan_walls(const std::vector<WallPiece>& walls, const PlanFrame& frame,
                                 const PlacedObservations& observations, const Map& map);

/// Rooms; those several times as long as wide are corridors. Each has the places whose anchor is in
/// it, whether the camera was in it, and its ceiling where that is seen.
std::vector<PlanRoom> plan_rooms(const RoomPartition& rooms, const VoxelEvidence& voxels,
                                 const PlanFrame& frame, const PlacedObservations& observations,
                                 const Map& map);

/// Doors, each with the rooms on its two sides.
std::vector<PlanDoor> plan_doors(const std::vector<DoorPiece>& doors, const RoomPartition& rooms,
                                 const VoxelEvidence& voxels, const PlanFrame& frame);

/// Cells that are occupied between 0.2 and 2 m above the floor, of twice the size of the voxels.
FloorPlan::Cells plan_cells(const VoxelEvidence& voxels);

}  // namespace placegraph
