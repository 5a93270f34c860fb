#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/scene/floor_plan_file.h>

#include <nlohmann/json.hpp>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace floor_plan_file_test {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// Half of the tenth of a millimetre to which a plan is rounded, and the last digit of a number.
constexpr double kRounding = 0.5e-4 + 1e-9;

Eigen::Vector2d point(Random& random) { return {random.uniform(-20, 20), random.uniform(-20, 20)}; }

std::vector<Eigen::Vector2d> polygon(Random& random) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 3 + random.index(4); ++i) points.push_back(point(random));
  return points;
}

FloorPlan random_plan(std::uint64_t seed, const SO3& R_plan_map) {
  Random random(seed);
  FloorPlan plan;
  plan.outcome = Outcome::ok();
  plan.R_plan_map = R_plan_map;
  plan.floor_y = random.uniform(-2, 2);
  plan.yaw_rad = random.uniform(0, 1.5);
  for (int i = 0; i < 5; ++i) {
    PlanWall wall;
    wall.a = point(random), wall.b = point(random), wall.normal = point(random).normalized();
    wall.sigma_m = random.uniform(0, 0.1), wall.low_m = random.uniform(0, 1);
    wall.high_m = random.uniform(1, 3), wall.observations = random.index(500);
    if (i % 2 == 0) wall.place = PlaceId(i);
    plan.walls.push_back(wall);
    PlanDoor door{point(random), point(random), random.uniform(1.9, 2.1), i % 3 == 0, {}};
    if (i > 0) door.rooms[static_cast<std::size_t>(i % 2)] = i - 1;  // 0 is a room
    plan.doors.push_back(door);
    PlanRoom room;
    room.label = "room \"" + std::to_string(i) + "\"", room.outline = polygon(random);
    for (int hole = 0; hole < i % 3; ++hole) room.holes.push_back(polygon(random));
    room.area_m2 = random.uniform(3, 30), room.ceiling_m = random.uniform(2, 4);
    room.entered = i % 2 == 0;
    for (int place = 0; place < i; ++place) room.places.emplace_back(3 * place);
    plan.rooms.push_back(room);
  }
  plan.cells.columns = plan.cells.rows = 1;
  plan.cells.log_odds = {1};
  return plan;
}

void expect_near(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  EXPECT_LE((a - b).lpNorm<Eigen::Infinity>(), kRounding);
}

void expect_near(const std::vector<Eigen::Vector2d>& a, const std::vector<Eigen::Vector2d>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) expect_near(a[i], b[i]);
}

class FloorPlanFile : public ::testing::Test {
 protected:
  FloorPlan read(const std::string& text) {
    return read_floor_plan(folder.write("floor_plan.json", text));
  }
  std::string refusal(const json& document) {
    const std::string path = folder.write("floor_plan.json", document.dump());
    return test::message_of([&] { (void)read_floor_plan(path); });
  }
  test::TemporaryFolder folder;
};

TEST_F(FloorPlanFile, ReadsThePlanItWrote) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const FloorPlan plan = random_plan(seed, SO3::exp({0.1 * seed, -1.2, 0.4}));
    const FloorPlan copy = read(to_json(plan));
    EXPECT_TRUE(copy.outcome);
    EXPECT_LT((copy.R_plan_map.matrix() - plan.R_plan_map.matrix()).norm(), 1e-14);
    EXPECT_NEAR(copy.floor_y, plan.floor_y, kRounding);
    EXPECT_EQ(copy.yaw_rad, plan.yaw_rad);
    ASSERT_EQ(copy.walls.size(), plan.walls.size());
    ASSERT_EQ(copy.doors.size(), plan.doors.size());
    ASSERT_EQ(copy.rooms.size(), plan.rooms.size());
    for (std::size_t i = 0; i < plan.walls.size(); ++i) {
      const PlanWall &a = copy.walls[i], &b = plan.walls[i];
      expect_near(a.a, b.a), expect_near(a.b, b.b), expect_near(a.normal, b.normal);
      EXPECT_NEAR(a.sigma_m, b.sigma_m, kRounding);
      EXPECT_NEAR(a.low_m, b.low_m, kRounding);
      EXPECT_NEAR(a.high_m, b.high_m, kRounding);
      EXPECT_EQ(a.observations, b.observations);
      EXPECT_EQ(a.place, b.place);
    }
    for (std::size_t i = 0; i < plan.doors.size(); ++i) {
      const PlanDoor &a = copy.doors[i], &b = plan.doors[i];
      expect_near(a.a, b.a), expect_near(a.b, b.b);
      EXPECT_NEAR(a.height_m, b.height_m, kRounding);
      EXPECT_EQ(a.closed, b.closed);
      EXPECT_EQ(a.rooms, b.rooms);
    }
    for (std::size_t i = 0; i < plan.rooms.size(); ++i) {
      const PlanRoom &a = copy.rooms[i], &b = plan.rooms[i];
      EXPECT_EQ(a.label, b.label);
      expect_near(a.outline, b.outline);
      ASSERT_EQ(a.holes.size(), b.holes.size());
      for (std::size_t k = 0; k < a.holes.size(); ++k) expect_near(a.holes[k], b.holes[k]);
      EXPECT_NEAR(a.area_m2, b.area_m2, kRounding);
      EXPECT_NEAR(a.ceiling_m, b.ceiling_m, kRounding);
      EXPECT_EQ(a.entered, b.entered);
      EXPECT_EQ(a.places, b.places);
    }
    EXPECT_TRUE(copy.cells.log_odds.empty());  // cells are not written
  }
}

TEST_F(FloorPlanFile, WritesWhatItReadInTheSameWords) {
  const std::string text = to_json(random_plan(9, SO3()));
  EXPECT_EQ(to_json(read(text)), text);
  EXPECT_TRUE(read(to_json(FloorPlan())).walls.empty());
}

TEST_F(FloorPlanFile, NamesTheKeyThatIsMissing) {
  const json whole = json::parse(to_json(random_plan(3, SO3())));
  for (const char* key : {"R_plan_map", "floor_y", "walls_yaw_rad", "walls", "doors", "rooms"}) {
    json document = whole;
    document.erase(key);
    EXPECT_THAT(refusal(document), AllOf(HasSubstr("floor_plan.json: is not a floor plan"),
                                         HasSubstr(std::string("'") + key + "'")));
  }
  for (const char* list : {"walls", "doors", "rooms"})
    for (const auto& [key, value] : whole[list][1].items()) {
      json document = whole;
      document[list][1].erase(key);
      EXPECT_THAT(refusal(document), HasSubstr("'" + key + "'")) << list;
    }
  json document = whole;
  document["walls"][0]["a"][1] = nullptr;
  EXPECT_THAT(refusal(document), HasSubstr("is not a floor plan"));
}

TEST_F(FloorPlanFile, ReadsATruePlanWithTheWallOfEachDoor) {
  const json door = {{"a", {0, 1}}, {"b", {1, 1}}, {"height_m", 2.1}, {"closed", true}};
  json open = door;
  open["closed"] = false;
  const json wall = {{"a", {0, 1}}, {"b", {9, 1}}, {"thickness_m", 0.2}, {"height_m", 2.7}};
  json walls = json::array({wall, wall, wall});
  walls[0]["doors"] = json::array();
  walls[1]["doors"] = json::array({door, open});
  walls[2]["doors"] = json::array({open});
  const json room = {{"name", "hall"}, {"low", {0, 1}}, {"high", {9, 4}}, {"ceiling_m", 2.5}};
  const json document = {{"rooms", json::array({room})}, {"walls", walls}};
  const TrueFloorPlan plan = read_true_floor_plan(folder.write("floorplan.json", document.dump()));
  ASSERT_EQ(plan.rooms.size(), 1U);
  EXPECT_EQ(plan.rooms[0].high, Eigen::Vector2d(9, 4));
  EXPECT_EQ(plan.rooms[0].ceiling_m, 2.5);
  ASSERT_EQ(plan.walls.size(), 3U);
  EXPECT_EQ(plan.walls[2].thickness_m, 0.2);
  EXPECT_EQ(plan.walls[2].height_m, 2.7);
  ASSERT_EQ(plan.doors.size(), 3U);
  EXPECT_TRUE(plan.doors[0].closed && !plan.doors[1].closed);
  EXPECT_EQ(plan.doors[1].wall, 1);
  EXPECT_EQ(plan.doors[2].wall, 2);
}

TEST_F(FloorPlanFile, OtherFilesAreNoPlans) {
  const std::string text = folder.write("a.json", "{\"rooms\": [");
  const std::string other = folder.write("b.json", "[]");
  EXPECT_THAT(test::message_of([&] { (void)read_floor_plan(text); }),
              HasSubstr("a.json: is not JSON"));
  EXPECT_THAT(test::message_of([&] { (void)read_true_floor_plan(other); }),
              HasSubstr("b.json: is not a true plan"));
  EXPECT_THROW((void)read_true_floor_plan(folder / "none.json"), FileError);
  EXPECT_THROW((void)read_floor_plan(folder.path()), FileError);
}

}  // namespace floor_plan_file_test
}  // namespace placegraph
