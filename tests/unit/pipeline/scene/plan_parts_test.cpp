#include <gtest/gtest.h>
#include <placegraph/pipeline/scene/plan_parts.h>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "tests/support/ids.h"

namespace placegraph {
namespace plan_parts_test {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Walls beside a map whose y is down; the plan is the map.
PlanFrame level_frame() {
  Eigen::Matrix3d upright;
  upright << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return PlanFrame(SE3(SO3(Eigen::Quaterniond(upright)), Vector3d(0, 0, 1.5)));
}

/// Two rooms of 4 m by 4 m and 10 m by 1.4 m, side by side along y of the walls, on cells of 0.1 m.
struct TwoRooms {
  VoxelEvidence voxels{Vector3d(0, 0, 0), Vector3d(10, 6, 3), 0.1, 0.25};
  RoomPartition rooms;
  PlacedObservations observations;
  Map map;
  TwoRooms() {
    rooms.room_of_cell = Image(voxels.rows(), voxels.columns(), CV_32SC1, cv::Scalar(0));
    rooms.room_of_cell(cv::Rect(0, 0, 40, 40)).setTo(1);
    rooms.room_of_cell(cv::Rect(0, 42, 100, 14)).setTo(2);
    rooms.rooms.resize(2);
    rooms.rooms[0].outline = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
    rooms.rooms[0].area_m2 = 16, rooms.rooms[0].width_m = 4;
    rooms.rooms[1].outline = {{0, 4.2}, {10, 4.2}, {10, 5.6}, {0, 5.6}};
    rooms.rooms[1].holes = {{{1, 4.5}, {2, 4.5}, {2, 5}}};
    rooms.rooms[1].area_m2 = 14, rooms.rooms[1].width_m = 1.4;
    Place place;
    place.id = PlaceId(5);
    place.T_map_place = SE3(SO3(), level_frame().T_walls_map().inverse() * Vector3d(8, 5, 1.5));
    map.place_graph.places = {place};
    observations.path = {Vector3d(2, 2, 1.5)};
  }
};

TEST(PlanParts, RoomsAreNamedAndHoldTheirPlaces) {
  const TwoRooms two;
  const auto rooms = plan_rooms(two.rooms, two.voxels, level_frame(), two.observations, two.map);
  ASSERT_EQ(rooms.size(), 2u);
  EXPECT_EQ(rooms[0].label, "room 1");
  EXPECT_EQ(rooms[1].label, "corridor 1");
  EXPECT_TRUE(rooms[0].entered);
  EXPECT_FALSE(rooms[1].entered);
  EXPECT_TRUE(rooms[0].places.empty());
  EXPECT_EQ(rooms[1].places, test::ids<PlaceId>({5}));
  ASSERT_EQ(rooms[1].outline.size(), 4u);
  EXPECT_NEAR((rooms[1].outline[1] - level_frame().plan_of({10, 4.2})).norm(), 0, 1e-12);
  ASSERT_EQ(rooms[1].holes.size(), 1u);
}

TEST(PlanParts, TheCeilingIsTheMedianOfWhatHangsAboveARoom) {
  TwoRooms two;
  for (int i = 0; i < 30; ++i) {
    const float x = 0.1F + 0.1F * static_cast<float>(i);
    two.observations.points.push_back({{x, 2, 2.5F}, {0, 0, -1}, 0, 0});
    two.observations.points.push_back({{x, 2, 2.2F}, {0, 0, 1}, 0, 0});   // the top of a cupboard
    two.observations.points.push_back({{x, 2, 0.7F}, {0, 0, -1}, 0, 0});  // a table from below
  }
  const auto rooms = plan_rooms(two.rooms, two.voxels, level_frame(), two.observations, two.map);
  EXPECT_NEAR(rooms[0].ceiling_m, 2.5, 1e-6);
  EXPECT_EQ(rooms[1].ceiling_m, PlanRoom().ceiling_m);  // nothing was seen
}

TEST(PlanParts, WallsLookToTheSideTheyAreSeenFrom) {
  const TwoRooms two;
  PlacedObservations observations = two.observations;
  observations.keyframes = test::ids<KeyframeId>({7, 9});
  Map map = two.map;
  Keyframe keyframe;
  keyframe.id = KeyframeId(9), keyframe.place = PlaceId(5);
  map.keyframes = {keyframe};
  WallPiece piece;
  piece.axis = 0, piece.sign = 1, piece.offset_m = 2, piece.from_m = 1, piece.to_m = 4;
  piece.low_m = 0.1, piece.high_m = 2.4, piece.sigma_m = 0.02, piece.count = 321,
  piece.observation = 1;
  WallPiece back = piece;
  back.sign = -1;
  const auto walls = plan_walls({piece, back}, level_frame(), observations, map);
  ASSERT_EQ(walls.size(), 2u);
  EXPECT_NEAR((walls[0].a - level_frame().plan_of({2, 1})).norm(), 0, 1e-12);
  EXPECT_NEAR((walls[0].b - level_frame().plan_of({2, 4})).norm(), 0, 1e-12);
  const Vector2d to_larger_x = level_frame().plan_of({1, 0}) - level_frame().plan_of({0, 0});
  EXPECT_NEAR(walls[0].normal.dot(to_larger_x), 1, 1e-12);
  EXPECT_NEAR(walls[1].normal.dot(to_larger_x), -1, 1e-12);
  EXPECT_EQ(walls[0].place, PlaceId(5));
  EXPECT_EQ(walls[0].observations, 321);
}

TEST(PlanParts, ADoorNamesTheRoomsOnBothSides) {
  const TwoRooms two;
  DoorPiece piece;  // in the wall between both rooms, across y
  piece.axis = 1, piece.sign = 1, piece.offset_m = 4.1, piece.from_m = 1, piece.to_m = 2;
  piece.head_m = 2.05;
  const auto doors = plan_doors({piece}, two.rooms, two.voxels, level_frame());
  ASSERT_EQ(doors.size(), 1u);
  EXPECT_EQ(doors[0].rooms[0], 1);
  EXPECT_EQ(doors[0].rooms[1], 0);
  EXPECT_NEAR((doors[0].a - level_frame().plan_of({1, 4.1})).norm(), 0, 1e-12);
  EXPECT_EQ(doors[0].height_m, 2.05);
}

TEST(PlanParts, CellsAreOccupiedWhereRaysEndAndFreeWhereTheyPass) {
  VoxelEvidence voxels(Vector3d(0, 0, 0), Vector3d(4, 4, 3), 0.1, 0.25);
  for (int i = 0; i < 20; ++i)
    voxels.add_ray(Vector3d(0.5, 2.05, 1.1), Vector3d(3.05, 2.05, 1.1), 0.1, true);
  const FloorPlan::Cells cells = plan_cells(voxels);
  EXPECT_EQ(cells.size_m, 0.2);
  const auto at = [&](double x, double y) {
    return cells.log_odds[static_cast<std::size_t>(y / 0.2) * cells.columns +
                          static_cast<std::size_t>(x / 0.2)];
  };
  EXPECT_GT(at(3.05, 2.05), 1);
  EXPECT_LT(at(1.5, 2.05), -1);
  EXPECT_EQ(at(1.5, 3.5), 0);
  // Only what is between 0.2 m and 2 m counts.
  VoxelEvidence high(Vector3d(0, 0, 0), Vector3d(4, 4, 3), 0.1, 0.25);
  high.add_ray(Vector3d(0.5, 2.05, 2.6), Vector3d(3.05, 2.05, 2.6), 0.1, true);
  for (const float cell : plan_cells(high).log_odds) EXPECT_EQ(cell, 0);
}

}  // namespace plan_parts_test
}  // namespace placegraph
