#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/plots/floor_plan_plot.h>

#include "../drawing/svg_check.h"

namespace placegraph {
namespace floor_plan_plot_test {

using Eigen::Vector2d;
using testing::Contains;
using testing::Not;

PlanRoom room_of(const std::string& label, const std::vector<Vector2d>& outline, double area_m2) {
  PlanRoom room;
  room.label = label;
  room.outline = outline;
  room.area_m2 = area_m2;
  return room;
}

/// A small room at the left of a large one, with a door of 1 m between them.
FloorPlan two_rooms(bool closed) {
  FloorPlan plan;
  plan.rooms = {room_of("room 1", {{0, 0}, {2, 0}, {2, 4}, {0, 4}}, 8),
                room_of("room 2", {{2, 0}, {8, 0}, {8, 4}, {2, 4}}, 24)};
  PlanWall wall;
  wall.a = {2, 0}, wall.b = {2, 4};
  plan.walls.push_back(wall);
  PlanDoor door;
  door.a = {2, 1}, door.b = {2, 2};
  door.closed = closed;
  plan.doors.push_back(door);
  return plan;
}

/// The lines of a colour, their pixels.
std::vector<std::vector<double>> lines_of(const std::string& svg, const std::string& colour,
                                          const std::string& width) {
  std::vector<std::vector<double>> lines;
  for (const std::string& tag : test::tags_of(svg, "polyline"))
    if (test::attribute(tag, "stroke") == colour && test::attribute(tag, "stroke-width") == width)
      lines.push_back(test::numbers_in(test::attribute(tag, "points")));
  return lines;
}

TEST(FloorPlanSvg, NamesRoomsWithTheirAreasAndTheirSum) {
  const std::string svg = floor_plan_svg(two_rooms(false), {"a plan", {}});
  test::expect_good_svg(svg);
  for (const char* text :
       {"a plan", "room 1", "8.0 m²", "room 2", "24.0 m²", "floor plan: 2 rooms, 32.0 m²"})
    EXPECT_THAT(test::texts_of(svg), Contains(text));
}

TEST(FloorPlanSvg, ADoorOpensIntoTheLargerRoom) {
  FloorPlan plan = two_rooms(false);
  for (const bool mirrored : {false, true}) {
    if (mirrored) std::swap(plan.rooms[0].area_m2, plan.rooms[1].area_m2);
    const auto arcs = lines_of(floor_plan_svg(plan, {}), "#d55e00", "1.3");
    ASSERT_EQ(arcs.size(), 2u);  // that of the legend has two points
    const std::vector<double>& arc = arcs[arcs[0].size() > 4 ? 0 : 1];
    const double door_px = arc[0];
    double least = door_px, most = door_px;
    for (std::size_t i = 0; i < arc.size(); i += 2)
      least = std::min(least, arc[i]), most = std::max(most, arc[i]);
    const double leaf_px = std::abs(arc[1] - arc.back());  // as long as the door is wide
    EXPECT_NEAR(most - door_px, mirrored ? 0 : leaf_px, 0.3);
    EXPECT_NEAR(door_px - least, mirrored ? leaf_px : 0, 0.3);
  }
}

TEST(FloorPlanSvg, TheLegendHasWhatIsDrawn) {
  const auto open = test::texts_of(floor_plan_svg(two_rooms(false), {}));
  const auto closed = test::texts_of(floor_plan_svg(two_rooms(true), {}));
  EXPECT_THAT(open, Contains("doorway (its hinges are not observed)"));
  EXPECT_THAT(open, Not(Contains("closed door")));
  EXPECT_THAT(closed, Contains("closed door"));
  EXPECT_THAT(closed, Not(Contains("doorway (its hinges are not observed)")));
  EXPECT_THAT(open, Not(Contains("path of the camera")));
  EXPECT_THAT(open, Not(Contains("ground truth")));
  TrueFloorPlan truth;
  truth.walls.push_back({{0, 0}, {8, 0}, 0.2, 2.5});
  const FloorPlanPicture picture{"", {{1, 1}, {2, 3}}, &truth};
  EXPECT_THAT(test::texts_of(floor_plan_svg(two_rooms(false), picture)),
              testing::IsSupersetOf({"path of the camera", "ground truth"}));
}

TEST(FloorPlanSvg, TheNameOfARoomLiesInItAndInNoHole) {
  // A ring of 1 m around a block, wider at the left: the middle of the outline is not free.
  FloorPlan plan;
  plan.rooms = {room_of("r", {{0, 0}, {12, 0}, {12, 10}, {0, 10}}, 60)};
  plan.rooms[0].holes = {{{3, 1}, {11, 1}, {11, 9}, {3, 9}}};
  const std::string svg = floor_plan_svg(plan, {});
  const auto frame = lines_of(svg, "#787878", "1").back();  // corners of the panel
  double x_px = 0;
  for (const std::string& tag : test::tags_of(svg, "text"))
    if (svg.substr(svg.find(tag) + tag.size() + 1, 2) == "r<") x_px = test::number(tag, "x");
  // The widest free square is 3 m wide at the left side, in a panel of 12 m and its margins.
  const double share = (x_px - frame[0]) / (frame[2] - frame[0]);
  EXPECT_NEAR(share * 12 * 1.06 - 0.03 * 12, 1.5, 0.5);
}

TEST(FloorPlanSvg, AnEmptyPlanIsAPictureToo) {
  const std::string svg = floor_plan_svg({}, {"nothing", {}});
  test::expect_good_svg(svg);
  EXPECT_THAT(test::texts_of(svg), Contains("floor plan: 0 rooms, 0.0 m²"));
}

}  // namespace floor_plan_plot_test
}  // namespace placegraph
