#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/scene/plan_parts.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <string>

namespace placegraph {
namespace {

/// The point at `along` on a line across `axis` at `offset`, in the frame of the walls.
Eigen::Vector2d on(int axis, double offset, double along) {
  return axis == 0 ? Eigen::Vector2d(offset, along) : Eigen::Vector2d(along, offset);
}

/// Number of the room at a point in the frame of the walls; -1: in none.
std::optional<int> room_at(const RoomPartition& rooms, const VoxelEvidence& voxels,
                           const Eigen::Vector2d& p) {
  const int c = voxels.column_of(p[0]), r = voxels.row_of(p[1]);
  const int number = voxels.contains(c, r) ? rooms.room_of_cell.at<int>(r, c) : 0;  // from 1
  return number > 0 ? std::optional(number - 1) : std::nullopt;
}

}  // namespace

std::vector<PlanWall> plan_walls(const std::vector<WallPiece>& walls, const PlanFrame& frame,
                                 const PlacedObservations& observations, const Map& map) {
  std::vector<PlanWall> result;
  for (const WallPiece& piece : walls) {
    PlanWall wall;
    wall.a = frame.plan_of(on(piece.axis, piece.offset_at(piece.from_m), piece.from_m));
    wall.b = frame.plan_of(on(piece.axis, piece.offset_at(piece.to_m), piece.to_m));
    const Eigen::Vector2d along = (wall.b - wall.a).normalized();
    wall.normal = Eigen::Vector2d(-along[1], along[0]);
    const Eigen::Vector2d side =
        frame.plan_of(on(piece.axis, piece.sign, 0)) - frame.plan_of({0, 0});
    if (wall.normal.dot(side) < 0) wall.normal = -wall.normal;
    wall.sigma_m = piece.sigma_m, wall.low_m = piece.low_m, wall.high_m = piece.high_m;
    wall.observations = piece.count;
    const Keyframe* keyframe = map.find_keyframe(observations.keyframes[piece.observation]);
    if (keyframe) wall.place = keyframe->place;
    result.push_back(wall);
  }
  return result;
}

std::vector<PlanRoom> plan_rooms(const RoomPartition& rooms, const VoxelEvidence& voxels,
                                 const PlanFrame& frame, const PlacedObservations& observations,
                                 const Map& map) {
  std::vector<PlanRoom> result;
  const auto polygon = [&](const std::vector<Eigen::Vector2d>& points) {
    std::vector<Eigen::Vector2d> in_plan;
    for (const Eigen::Vector2d& p : points) in_plan.push_back(frame.plan_of(p));
    return in_plan;
  };
  int corridors = 0, others = 0;
  for (const RoomPartition::Room& region : rooms.rooms) {
    PlanRoom room;
    room.outline = polygon(region.outline);
    for (const auto& hole : region.holes) room.holes.push_back(polygon(hole));
    room.area_m2 = region.area_m2;
    // Several times as long as wide.
    const bool corridor =
        region.area_m2 > 5 * region.width_m * region.width_m && region.width_m < 4;
    room.label =
        corridor ? "corridor " + std::to_string(++corridors) : "room " + std::to_string(++others);
    result.push_back(std::move(room));
  }
  for (const Eigen::Vector3d& p : observations.path)
    if (const auto room = room_at(rooms, voxels, p.head<2>())) result[*room].entered = true;
  for (const Place& place : map.place_graph.places) {
    const auto room =
        room_at(rooms, voxels, (frame.T_walls_map() * place.T_map_place.translation()).head<2>());
    if (room) result[*room].places.push_back(place.id);
  }
  std::vector<std::vector<double>> ceilings(result.size());
  for (const PlacedPoint& p : observations.points) {
    if (p.normal[2] > -0.95F || p.point[2] < 1.8F) continue;
    if (const auto room = room_at(rooms, voxels, p.point.head<2>().cast<double>()))
      ceilings[*room].push_back(p.point[2]);
  }
  for (std::size_t i = 0; i < ceilings.size(); ++i)
    if (ceilings[i].size() >= 20) result[i].ceiling_m = median_of(ceilings[i]);
  return result;
}

std::vector<PlanDoor> plan_doors(const std::vector<DoorPiece>& doors, const RoomPartition& rooms,
                                 const VoxelEvidence& voxels, const PlanFrame& frame) {
  std::vector<PlanDoor> result;
  for (const DoorPiece& piece : doors) {
    PlanDoor door;
    door.a = frame.plan_of(on(piece.axis, piece.offset_m, piece.from_m));
    door.b = frame.plan_of(on(piece.axis, piece.offset_m, piece.to_m));
    door.height_m = piece.head_m, door.closed = piece.closed;
    const double middle = 0.5 * (piece.from_m + piece.to_m);
    for (int side = 0; side < 2; ++side)
      for (const double distance : {0.1, 0.2, 0.35, 0.5}) {
        const double at = piece.offset_m + piece.sign * (side ? -distance - 0.1 : distance);
        if (!door.rooms[side])
          door.rooms[side] = room_at(rooms, voxels, on(piece.axis, at, middle));
      }
    result.push_back(door);
  }
  return result;
}

FloorPlan::Cells plan_cells(const VoxelEvidence& voxels) {
  // Log odds of a surface and of a ray are those of OctoMap (Hornung 2013); the bound is chosen.
  constexpr double kHit = 0.85, kPass = 0.4, kMost = 5;
  FloorPlan::Cells cells;
  cells.size_m = 2 * voxels.cell_m();
  cells.low = voxels.low().head<2>();
  cells.columns = voxels.columns() / 2, cells.rows = voxels.rows() / 2;
  cells.log_odds.assign(static_cast<std::size_t>(cells.columns) * cells.rows, 0.0F);
  const int first = std::max(0, voxels.layer_of(0.2)), last = voxels.layer_of(2.0);
  for (int r = 0; r < 2 * cells.rows; ++r)
    for (int c = 0; c < 2 * cells.columns; ++c) {
      double sum = 0;
      for (int l = first; l <= std::min(last, voxels.layers() - 1); ++l)
        sum += kHit * voxels.hits(c, r, l) - kPass * voxels.passes(c, r, l);
      float& cell = cells.log_odds[static_cast<std::size_t>(r / 2) * cells.columns + c / 2];
      cell = static_cast<float>(std::clamp(cell + sum, -kMost, kMost));
    }
  return cells;
}

}  // namespace placegraph
