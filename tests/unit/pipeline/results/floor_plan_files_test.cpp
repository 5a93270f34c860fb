#include <placegraph/pipeline/results/floor_plan_files.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/io/scene/floor_plan_file.h>

#include "tests/support/map_bits.h"
#include "tests/support/random_map.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace floor_plan_files_test {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::vector<Eigen::Vector2d> rectangle(double width, double height) {
  return {{0, 0}, {width, 0}, {width, height}, {0, height}};
}

/// A room of 4 m by 3 m of which walls of this length were observed.
FloorPlan room_with_walls(double length_m) {
  FloorPlan plan;
  plan.outcome = Outcome::ok();
  plan.floor_y = 1.5;
  PlanRoom& room = plan.rooms.emplace_back();
  room.label = "room 1";
  room.outline = rectangle(4, 3);
  for (const double share : {0.25, 0.75}) {
    PlanWall& wall = plan.walls.emplace_back();
    wall.a = {0, 0}, wall.b = {0, share * length_m}, wall.normal = {1, 0};
  }
  return plan;
}

TEST(WalledShare, IsTheLengthOfWallsOverThatOfOutlines) {
  EXPECT_DOUBLE_EQ(walled_share(room_with_walls(7)), 0.5);
  EXPECT_DOUBLE_EQ(walled_share(room_with_walls(0)), 0);
  EXPECT_DOUBLE_EQ(walled_share(room_with_walls(99)), 1);
  FloorPlan plan = room_with_walls(7);
  plan.rooms[0].holes.push_back(rectangle(1, 2));  // 6 m more
  EXPECT_DOUBLE_EQ(walled_share(plan), 7.0 / 20);
  plan.rooms.push_back(plan.rooms[0]);
  EXPECT_DOUBLE_EQ(walled_share(plan), 7.0 / 40);
  plan.rooms.clear();
  EXPECT_EQ(walled_share(plan), 0);
}

TEST(WalledShare, IsDoubtedBelowAHalf) {
  EXPECT_FALSE(doubt_of(room_with_walls(7)));
  EXPECT_FALSE(doubt_of(room_with_walls(14)));
  EXPECT_THAT(*doubt_of(room_with_walls(3.5)), HasSubstr("along 25 % of the outlines"));
  EXPECT_TRUE(doubt_of(FloorPlan()));
}

class FloorPlanFiles : public ::testing::Test {
 protected:
  FloorPlanFiles() {
    Random random(2);
    stored = test::random_map(random, 3);
    stored.map.landmarks.clear();
  }
  test::TemporaryFolder dir;
  StoredMap stored;
};

TEST_F(FloorPlanFiles, AreWrittenInThreeForms) {
  write_floor_plan(dir.path(), room_with_walls(7), stored.map, "a & b");
  const FloorPlan read = read_floor_plan(dir / "floor_plan.json");
  EXPECT_EQ(read.walls.size(), 2U);
  EXPECT_EQ(read.floor_y, 1.5);
  EXPECT_THAT(test::read_file(dir / "floor_plan.svg"), HasSubstr("a &amp; b"));
  EXPECT_THAT(test::read_file(dir / "floor_plan.png"), StartsWith("\x89PNG"));
}

TEST_F(FloorPlanFiles, LabelsOfPlacesAreSavedAndNothingElseChanges) {
  const std::string path = dir / "map.db";
  write_map(path, stored);
  PlaceGraph labelled = stored.map.place_graph;
  labelled.places.erase(labelled.places.begin() + 1);  // this one keeps its labels
  labelled.places[0].labels = {"kitchen", "warm"};
  labelled.places[1].labels.clear();
  labelled.places[1].scale = 77;
  labelled.places.emplace_back().id = PlaceId(50);
  save_labels(path, labelled);
  const Map saved = read_map(path).map;
  ASSERT_EQ(saved.place_graph.places.size(), 3U);
  EXPECT_EQ(saved.place_graph.places[0].labels, labelled.places[0].labels);
  EXPECT_EQ(saved.place_graph.places[1].labels, stored.map.place_graph.places[1].labels);
  EXPECT_TRUE(saved.place_graph.places[2].labels.empty());
  write_map(dir / "other.db", stored);
  EXPECT_EQ(test::map_bits(saved), test::map_bits(read_map(dir / "other.db").map));
}

}  // namespace floor_plan_files_test
}  // namespace placegraph
