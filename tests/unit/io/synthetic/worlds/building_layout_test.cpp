#include <gtest/gtest.h>
#include <placegraph/io/synthetic/render/renderer.h>
#include <placegraph/io/synthetic/worlds/building_layout.h>

#include <nlohmann/json.hpp>

namespace placegraph::synthetic {
namespace building_layout_test {

BuildingLayout box_with_door() {
  BuildingLayout plan;
  plan.rooms.push_back({"room", {0, 0}, {6, 8}, 2.5, 0});
  plan.add_ring({0, 0}, {6, 8}, 2.5, 0.2);
  plan.walls[2].openings = {{2.0, 3.0, 2.0, Opening::Leaf::kNone}};  // north wall, from x = 6 to 0
  return plan;
}

double depth_ahead(const Scene& scene, const Eigen::Vector3d& from) {
  View view;
  view.camera.width = view.camera.height = 33;
  view.camera.fx = view.camera.fy = 100;
  view.camera.cx = view.camera.cy = 16;
  view.T_scene_cam = SE3(SO3(), from);
  return depth_image(render(scene, view, 1, false, 1)).at<float>(16, 16);
}

TEST(BuildingLayout, WallsStandWhereThePlanSaysAndDoorsAreHoles) {
  Scene scene;
  scene.outdoor = false;
  build_rooms(box_with_door(), scene);
  EXPECT_NEAR(depth_ahead(scene, {1, -1.4, 2}), 8 - 0.1 - 2, 1e-5);    // the wall's near side
  EXPECT_EQ(depth_ahead(scene, {3.5, -1.4, 2}), 0);                    // through the door
  EXPECT_NEAR(depth_ahead(scene, {3.5, -2.2, 2}), 8 - 0.1 - 2, 1e-5);  // above the door
}

TEST(BuildingLayout, JsonHoldsTheShiftedPlan) {
  const auto json = nlohmann::json::parse(to_json(box_with_door(), {1, 2}, 1.4));
  EXPECT_EQ(json["rooms"].size(), 1U);
  EXPECT_EQ(json["walls"].size(), 4U);
  EXPECT_DOUBLE_EQ(json["floor_y"], 1.4);
  EXPECT_DOUBLE_EQ(json["rooms"][0]["high"][1], 6);
  const auto& door = json["walls"][2]["doors"][0];
  EXPECT_DOUBLE_EQ(door["a"][0], 3);  // x = 6 - 2 - 1
  EXPECT_DOUBLE_EQ(door["a"][1], 6);
  EXPECT_DOUBLE_EQ(door["height_m"], 2);
}

}  // namespace building_layout_test
}  // namespace placegraph::synthetic
