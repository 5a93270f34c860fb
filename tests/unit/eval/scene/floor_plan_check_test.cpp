#include <gmock/gmock.h>
#include <numbers>

#include <gtest/gtest.h>
#include <placegraph/eval/plots/floor_plan_plot.h>
#include <placegraph/eval/scene/floor_plan_check.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/scene/floor_plan_file.h>

#include "../drawing/svg_check.h"
#include "tests/support/ids.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace floor_plan_check_test {

using Eigen::Vector2d;

/// A room of 4 x 6 m with a closed door in the wall at x = 4.
TrueFloorPlan one_room() {
  TrueFloorPlan truth;
  truth.rooms = {{"room", {0, 0}, {4, 6}, 2.5}};
  truth.walls = {{{0, 0}, {4, 0}, 0.2, 2.5},
                 {{4, 0}, {4, 6}, 0.2, 2.5},
                 {{4, 6}, {0, 6}, 0.2, 2.5},
                 {{0, 6}, {0, 0}, 0.2, 2.5}};
  truth.doors = {{{4, 2}, {4, 3}, 2, true, 1}};
  return truth;
}

PlanWall wall(const Vector2d& a, const Vector2d& b, const Vector2d& normal) {
  PlanWall w;
  w.a = a, w.b = b, w.normal = normal;
  return w;
}

/// Seen right but for the wall at x = 0, which is 10 cm off.
FloorPlan estimated_plan() {
  FloorPlan plan;
  plan.outcome = Outcome::ok();
  plan.walls = {wall({0.2, 0.1}, {3.9, 0.1}, {0, 1}), wall({3.9, 0.1}, {3.9, 5.9}, {-1, 0}),
                wall({0.2, 5.9}, {3.9, 5.9}, {0, -1}), wall({0.2, 0.1}, {0.2, 5.9}, {1, 0})};
  plan.doors.push_back({{3.9, 2.05}, {3.9, 3.0}, 2.0, true, {0, -1}});
  PlanRoom room;
  room.label = "room 1";
  room.outline = {{0.2, 0.1}, {3.9, 0.1}, {3.9, 5.9}, {0.2, 5.9}};
  room.area_m2 = 3.7 * 5.8, room.entered = true, room.places = test::ids<PlaceId>({3});
  plan.rooms.push_back(room);
  return plan;
}

/// Turning in the middle of the room.
std::vector<SE3> rotating() {
  std::vector<SE3> poses;
  for (int i = 0; i < 24; ++i)
    poses.emplace_back(SO3::exp({0, i * std::numbers::pi / 12, 0}), Eigen::Vector3d(2, 0, 3));
  return poses;
}

TEST(FloorPlanCheck, TellsErrorsOfWallsRoomsAndDoors) {
  const FloorPlanCheck check = check_floor_plan(estimated_plan(), one_room(), SE3(), rotating());
  EXPECT_LT(check.truth_to_plan_median_m, 1e-9);
  // The corner beside the wall that is off, and what stands before the door.
  EXPECT_NEAR(check.truth_found_share, 1, 0.02);
  EXPECT_NEAR(check.plan_right_share, 1, 0.06);
  ASSERT_EQ(check.rooms.size(), 1U);
  EXPECT_NEAR(check.rooms[0].iou, 3.7 / 3.8, 0.03);  // cells of 5 cm
  EXPECT_EQ(check.doors_seen, 1);
  EXPECT_EQ(check.doors_found, 1);
  EXPECT_EQ(check.doors_state_right, 1);
  EXPECT_EQ(check.doors_false, 0);
}

TEST(FloorPlanCheck, CountsPixelsWithoutOrientation) {
  FloorPlan empty;
  const FloorPlanCheck check = check_floor_plan(empty, one_room(), SE3(), rotating());
  EXPECT_EQ(check.truth_to_plan_median_m, 1);
  EXPECT_EQ(check.doors_found, 0);
  EXPECT_EQ(check.rooms.at(0).iou, 0);
}

TEST(FloorPlanFile, ReadsWhatItWrites) {
  test::TemporaryFolder dir;
  dir.write("plan.json", to_json(estimated_plan()));
  const FloorPlan plan = read_floor_plan(dir / "plan.json");
  ASSERT_EQ(plan.walls.size(), 4U);
  EXPECT_EQ(plan.doors.at(0).rooms, (std::array<std::optional<int>, 2>{0, std::nullopt}));
  EXPECT_EQ(plan.rooms.at(0).places, test::ids<PlaceId>({3}));
  EXPECT_EQ(to_json(plan), to_json(estimated_plan()));
  dir.write("cut.json", to_json(estimated_plan()).substr(0, 100));
  EXPECT_THROW((void)read_floor_plan(dir / "cut.json"), FileError);
  dir.write("other.json", "{}");
  EXPECT_THROW((void)read_floor_plan(dir / "other.json"), FileError);
  EXPECT_THROW((void)read_true_floor_plan(dir / "other.json"), FileError);
  EXPECT_THROW((void)read_true_floor_plan(dir / "none.json"), FileError);
}

TEST(FloorPlanPlot, HasALegendForAllThatItShows) {
  FloorPlanPicture picture;
  picture.title = "a room";
  picture.path = {{0, 0}, {1, 1}};
  const TrueFloorPlan truth = one_room();
  picture.truth = &truth;
  const std::string svg = floor_plan_svg(estimated_plan(), picture);
  test::expect_good_svg(svg);
  for (const char* text : {"room 1", "21.5 m²", "wall", "room", "path of the camera",
                           "ground truth", "x [m]", "z [m]"})
    EXPECT_THAT(test::texts_of(svg), testing::Contains(text));
  test::expect_good_svg(floor_plan_svg({}, {}));
}

}  // namespace floor_plan_check_test
}  // namespace placegraph
