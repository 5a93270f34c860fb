#include <gtest/gtest.h>
#include <placegraph/pipeline/scene/plan_frame.h>

namespace placegraph {
namespace plan_frame_test {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Walls whose z is up, of a map whose y is nearly down: tilted by 3 degrees, turned by 0.4 rad
/// about the vertical, its origin 1.5 m above the floor.
SE3 walls_of_map() {
  Eigen::Matrix3d upright;  // x of the walls is x of the plan, y is z, z is -y
  upright << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const SO3 R_walls_map =
      SO3::exp({0, 0, 0.4}) * SO3(Eigen::Quaterniond(upright)) * SO3::exp({0.05, 0, 0.02});
  return SE3(R_walls_map, Vector3d(0.3, -0.2, 1.5));
}

TEST(PlanFrame, ThePlansYIsTheVerticalOfTheBuilding) {
  const PlanFrame frame(walls_of_map());
  const Vector3d down_map = -walls_of_map().rotation().matrix().row(2).transpose();
  EXPECT_NEAR((frame.R_plan_map() * down_map - Vector3d::UnitY()).norm(), 0, 1e-12);
  // It is turned by no more than the tilt: the axis of the turn is level.
  EXPECT_NEAR(frame.R_plan_map().log().norm(), std::acos(down_map.y()), 1e-12);
}

TEST(PlanFrame, PointsOfTheFloorAreThoseOfTheRotatedMap) {
  const SE3 T_walls_map = walls_of_map();
  const PlanFrame frame(T_walls_map);
  for (const Vector2d& p : {Vector2d(0, 0), Vector2d(3, 1), Vector2d(-2, 5)}) {
    const Vector3d in_map = T_walls_map.inverse() * Vector3d(p[0], p[1], 0);
    const Vector3d in_plan = frame.R_plan_map() * in_map;
    EXPECT_NEAR((frame.plan_of(p) - Vector2d(in_plan[0], in_plan[2])).norm(), 0, 1e-12);
    EXPECT_NEAR(frame.floor_y(), in_plan[1], 1e-12);  // the floor is level
  }
}

TEST(PlanFrame, TheYawIsThatOfTheWallsFirstAxis) {
  const PlanFrame frame(walls_of_map());
  const Vector2d x = frame.plan_of({1, 0}) - frame.plan_of({0, 0});
  EXPECT_NEAR(std::atan2(x[1], x[0]), frame.yaw_rad(), 1e-12);
  EXPECT_NEAR(frame.yaw_rad(), -0.4, 0.06);
}

}  // namespace plan_frame_test
}  // namespace placegraph
