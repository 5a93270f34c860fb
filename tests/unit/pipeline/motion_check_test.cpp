#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/pipeline/motion_check.h>

namespace placegraph {
namespace {

using testing::HasSubstr;

/// A drive of `speed` at 10 Hz that turns by `turn_deg` about `axis` of the camera in all.
Trajectory drive(double speed, const Eigen::Vector3d& axis, double turn_deg) {
  Trajectory trajectory;
  SE3 T_world_cam;
  constexpr int kFrames = 200;
  for (int i = 0; i < kFrames; ++i) {
    trajectory.poses.push_back({i * 100'000'000LL, T_world_cam.isometry()});
    T_world_cam = T_world_cam * SE3(SO3::exp(deg_to_rad(turn_deg / kFrames) * axis),
                                    Eigen::Vector3d(0, 0, 0.1 * speed));
  }
  return trajectory;
}

Camera camera(int width, int height) {
  return {.width = width,
          .height = height,
          .fx = 300,
          .fy = 300,
          .cx = 0.5 * width,
          .cy = 0.5 * height};
}

const Eigen::Vector3d kX = Eigen::Vector3d::UnitX(), kY = Eigen::Vector3d::UnitY();

TEST(Turns, AreSummedByAxis) {
  const Turns turns = turns_of(drive(10, kY, 90));
  EXPECT_NEAR(turns.about_y_deg, 88, 2);
  EXPECT_NEAR(turns.about_x_deg, 0, 1e-6);
}

TEST(OddPosture, IsThatOfACameraOnItsSide) {
  EXPECT_FALSE(odd_posture(camera(640, 480), turns_of(drive(10, kY, 90))));
  EXPECT_FALSE(odd_posture(camera(640, 480), turns_of(drive(10, kY, 0))));
  const auto side = odd_posture(camera(640, 480), turns_of(drive(10, kX, 90)));
  ASSERT_TRUE(side);
  EXPECT_TRUE(side->doubts_scale);
  EXPECT_THAT(side->text, HasSubstr("as if it lay on its side"));
}

TEST(OddPosture, OfHighImagesIsToldUnlessTheyTurnUpright) {
  EXPECT_THAT(odd_posture(camera(480, 640), turns_of(drive(10, kY, 0)))->text,
              HasSubstr("higher than wide"));
  EXPECT_FALSE(odd_posture(camera(480, 640), turns_of(drive(10, kY, 60))));
}

TEST(OddSpeed, IsFasterThanAnyVehicle) {
  EXPECT_FALSE(odd_speed(drive(40, kY, 0)));
  const auto note = odd_speed(drive(1000, kY, 0));
  ASSERT_TRUE(note);
  EXPECT_TRUE(note->doubts_scale);
  EXPECT_THAT(note->text, HasSubstr("moves at 1e+03 m/s"));
  Trajectory lost = drive(1000, kY, 0);
  for (StampedPose& pose : lost.poses) pose.T_world_body.reset();
  EXPECT_FALSE(odd_speed(lost));
  EXPECT_FALSE(odd_speed({}));
}

}  // namespace
}  // namespace placegraph
