#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/kitti/kitti_check.h>

#include <numbers>

#include "tests/support/trajectories.h"

namespace placegraph {
namespace kitti_check_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// The drive with every pose multiplied on the right: poses of another sensor of the vehicle.
Trajectory mounted(Trajectory drive, const Eigen::Isometry3d& T_cam_sensor) {
  for (StampedPose& pose : drive.poses) pose.T_world_body = *pose.T_world_body * T_cam_sensor;
  return drive;
}

TEST(KittiCheck, KnowsTheFramesOfTheSequences) {
  int training = 0, test = 0;
  for (int i = 0; i <= 10; ++i) training += *kitti_frames(fmt::format("{:02d}", i));
  for (const std::string& name : kitti_test_sequences()) test += *kitti_frames(name);
  // The benchmark publishes 23,201 frames with ground truth and 20,351 without.
  EXPECT_EQ(training, 23201);
  EXPECT_EQ(test, 20351);
  EXPECT_EQ(kitti_frames("04"), 271);
  EXPECT_EQ(kitti_frames("22"), std::nullopt);
  EXPECT_EQ(kitti_frames("4"), std::nullopt);
}

TEST(KittiCheck, CountsOnePoseForEachFrame) {
  EXPECT_EQ(kitti_count_fault(271, 271, true), "");
  EXPECT_THAT(kitti_count_fault(270, 271, true),
              HasSubstr("270 poses, but the ground truth has 271"));
  EXPECT_THAT(kitti_count_fault(272, 271, false), HasSubstr("272 poses, but the sequence has 271"));
}

TEST(KittiCheck, ACameraThatLooksForwardIsNoMatterOfDoubt) {
  EXPECT_THAT(kitti_pose_warnings(test::winding_drive(200, 1, false)), IsEmpty());
  // Nor is one that stands, or turns on the spot: it shows no direction.
  EXPECT_THAT(kitti_pose_warnings(test::winding_drive(200, 0, false)), IsEmpty());
  EXPECT_THAT(kitti_pose_warnings({}), IsEmpty());
}

TEST(KittiCheck, AFirstPoseThatIsNotTheIdentityIsNamed) {
  Trajectory drive = test::winding_drive(200, 1, false);
  for (StampedPose& pose : drive.poses) pose.T_world_body->translation().x() += 2;
  EXPECT_THAT(kitti_start_warnings(drive), ElementsAre(HasSubstr("not the identity (off by 2)")));
}

TEST(KittiCheck, PosesOfAnotherSensorAreNamedByTheirAxis) {
  constexpr double kQuarter = std::numbers::pi / 2;
  const Trajectory drive = test::winding_drive(200, 1, false);
  // Forward is x of a laser scanner, which KITTI mounts so: x = z of the camera, z = -y.
  Eigen::Isometry3d T_cam_laser = Eigen::Isometry3d::Identity();
  T_cam_laser.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  EXPECT_THAT(kitti_pose_warnings(mounted(drive, T_cam_laser)),
              ElementsAre(HasSubstr("first pose"), HasSubstr("moves along its x axis")));
  EXPECT_THAT(kitti_pose_warnings(mounted(drive, test::isometry({0, 2 * kQuarter, 0}, {0, 0, 0}))),
              ElementsAre(HasSubstr("first pose"), HasSubstr("moves along its -z axis")));
}

TEST(KittiCheck, InversePosesAreNamed) {
  Trajectory drive = test::winding_drive(200, 1, false);
  for (StampedPose& pose : drive.poses) pose.T_world_body = pose.T_world_body->inverse();
  EXPECT_THAT(kitti_pose_warnings(drive), ElementsAre(HasSubstr("inverse")));
}

}  // namespace kitti_check_test
}  // namespace placegraph
