#include <placegraph/graph/core/random.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include "tests/support/data.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace trajectory_file_test {

using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;

const std::string kIdentityLine = "1 0 0 0 0 1 0 0 0 0 1 0\n";

TEST(KittiTrajectory, HoldsThePoseOfTheCameraInTheWorldRowByRow) {
  const TemporaryFolder folder;
  // Camera turned by +90 degrees about y (z forward becomes x), at (1, 2, 3).
  const auto path = folder.write("p.txt", "0 0 1 1 0 1 0 2 -1 0 0 3\n" + kIdentityLine);
  const Trajectory trajectory = read_trajectory(path);
  ASSERT_EQ(trajectory.size(), 2u);
  EXPECT_FALSE(trajectory.has_times);
  EXPECT_EQ(trajectory.poses[1].stamp_ns, 1);
  const Eigen::Vector3d p_world = *trajectory.poses[0].T_world_body * Eigen::Vector3d(0, 0, 5);
  EXPECT_EQ(p_world, Eigen::Vector3d(6, 2, 3));
}

TEST(KittiTrajectory, TakesItsTimesFromAnotherFileOfTheSameLength) {
  const TemporaryFolder folder;
  const auto path = folder.write("p.txt", kIdentityLine + kIdentityLine);
  const Trajectory timed = read_trajectory(path, folder.write("t.txt", "0.5\n0.6\n"));
  EXPECT_TRUE(timed.has_times);
  EXPECT_EQ(timed.poses[1].stamp_ns, 600000000);
  const std::string three = folder.write("t3.txt", "0\n1\n2\n");
  EXPECT_THAT(message_of([&] { read_trajectory(path, three); }),
              HasSubstr("t3.txt: holds 3 times, but"));
}

TEST(KittiTrajectory, MarksLostFramesByTwelveNans) {
  const TemporaryFolder folder;
  const std::string nans = "nan nan nan nan nan nan nan nan nan nan nan nan\n";
  const Trajectory trajectory = read_trajectory(folder.write("p", kIdentityLine + nans));
  EXPECT_TRUE(trajectory.poses[0].T_world_body.has_value());
  EXPECT_FALSE(trajectory.poses[1].T_world_body.has_value());
  const std::string some = folder.write("q", kIdentityLine + "nan 0 0 0 0 1 0 0 0 0 1 0\n");
  EXPECT_THAT(message_of([&] { read_trajectory(some); }),
              HasSubstr("q:2: 1 of 12 numbers are nan"));
}

TEST(KittiTrajectory, KeepsTheMatrixAsItIsWritten) {
  const TemporaryFolder folder;
  const Trajectory trajectory =
      read_trajectory(folder.write("p", "0.99999994 0 0 0 0 1 0 0 0 0 1 0\n"));
  EXPECT_EQ(trajectory.poses[0].T_world_body->matrix()(0, 0), 0.99999994);
}

TEST(KittiTrajectory, NamesTheLineOfEveryFault) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& second_line) {
    const std::string path = folder.write("p.txt", kIdentityLine + second_line);
    return message_of([&] { read_trajectory(path); });
  };
  EXPECT_THAT(message("1 0 0 0 0 1 0"), HasSubstr("p.txt:2: expected 12 fields (m00 m01"));
  EXPECT_THAT(message("1 0 0 0 0 1 0 0 0 0 1 x"), HasSubstr("p.txt:2: pose: 'x' is not a number"));
  EXPECT_THAT(message("1 0 0 inf 0 1 0 0 0 0 1 0"),
              HasSubstr("p.txt:2: pose: 'inf' is not finite"));
  EXPECT_THAT(message("2 0 0 0 0 2 0 0 0 0 2 0"),
              HasSubstr("p.txt:2: the 3x3 part is not a rotation"));
  EXPECT_THAT(message("-1 0 0 0 0 1 0 0 0 0 1 0"), HasSubstr("p.txt:2: the 3x3 part is not"));
  EXPECT_THAT(message("1 0 0 0 0 1 0"), HasSubstr("found 7"));
  EXPECT_THAT(message(std::string(1 << 16, '1')), HasSubstr("p.txt:2: expected 12"));
}

TEST(TumTrajectory, HasSecondsAndTheScalarLast) {
  const TemporaryFolder folder;
  // 90 degrees about z: q = (0, 0, sin 45, cos 45).
  const Trajectory trajectory = read_trajectory(
      folder.write("p", "# c\n1403636579.763555527 1 2 3 0 0 0.70710678 0.70710678\n"));
  EXPECT_TRUE(trajectory.has_times);
  EXPECT_EQ(trajectory.poses[0].stamp_ns, 1403636579763555527);
  const Eigen::Vector3d p_world = *trajectory.poses[0].T_world_body * Eigen::Vector3d(1, 0, 0);
  EXPECT_LT((p_world - Eigen::Vector3d(1, 3, 3)).norm(), 1e-8);
}

TEST(TumTrajectory, NamesTheLineOfEveryFault) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& second_line) {
    const std::string path = folder.write("p.txt", "1 0 0 0 0 0 0 1\n" + second_line);
    return message_of([&] { read_trajectory(path); });
  };
  EXPECT_THAT(message("2 0 0 0 0 0 0"),
              HasSubstr("p.txt:2: expected 8 fields (t x y z qx qy qz qw), found 7"));
  EXPECT_THAT(message("2 0 0 nan 0 0 0 1"), HasSubstr("p.txt:2: pose: 'nan' is not finite"));
  EXPECT_THAT(message("2 0 0 a 0 0 0 1"), HasSubstr("p.txt:2: pose: 'a' is not a number"));
  EXPECT_THAT(message("2 0 0 0 0 0 0 0.9"), HasSubstr("p.txt:2: the quaternion has length 0.9"));
  EXPECT_THAT(message("2 0 0 0 0 0 0 0"), HasSubstr("p.txt:2: the quaternion has length 0"));
  EXPECT_THAT(message("0.9 0 0 0 0 0 0 1"),
              HasSubstr("p.txt:2: time 900000000 ns does not increase"));
  EXPECT_THAT(message("1403636579763555527 0 0 0 0 0 0 1"),
              HasSubstr("p.txt:2: time: '1403636579763555527' is not a time in seconds"));
}

TEST(EurocTrajectory, HasNanosecondsTheScalarFirstAndColumnsWeIgnore) {
  const TemporaryFolder folder;
  const Trajectory trajectory = read_trajectory(folder.write(
      "p.csv", "#timestamp,x\n1403636579763555527,1,2,3,0.70710678,0,0,0.70710678,9,nan,x\r\n"));
  EXPECT_EQ(trajectory.poses[0].stamp_ns, 1403636579763555527);
  const Eigen::Vector3d p_world = *trajectory.poses[0].T_world_body * Eigen::Vector3d(1, 0, 0);
  EXPECT_LT((p_world - Eigen::Vector3d(1, 3, 3)).norm(), 1e-8);
}

TEST(EurocTrajectory, NamesTheLineOfEveryFault) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& second_line) {
    const std::string path = folder.write("p.csv", "1,0,0,0,1,0,0,0\n" + second_line);
    return message_of([&] { read_trajectory(path); });
  };
  EXPECT_THAT(message("2,0,0,0,1,0,0"),
              HasSubstr("p.csv:2: expected 8 fields (t_ns x y z qw qx qy qz ...)"));
  EXPECT_THAT(message("2,0,0,nan,1,0,0,0"), HasSubstr("p.csv:2: pose: 'nan' is not finite"));
  EXPECT_THAT(message("2,0,0,,1,0,0,0"), HasSubstr("p.csv:2: pose: '' is not a number"));
  EXPECT_THAT(message_of([&] {
                read_trajectory(folder.write("p.csv",
                                             "1600000000000000000,0,0,0,1,0,0,0\n"
                                             "1600000000000000002.5,0,0,0,1,0,0,0\n"));
              }),
              HasSubstr("p.csv:2: time [ns]: '1600000000000000002.5' is not a whole number"));
  EXPECT_THAT(message("99999999999999999999,0,0,0,1,0,0,0"), HasSubstr("p.csv:2: time [ns]"));
}

TEST(Trajectory, OfNumberedFramesKeepsTheirNumbersAndTakesTheirTimes) {
  const TemporaryFolder folder;
  const std::string path = folder.write("p", "0 " + kIdentityLine + "2 " + kIdentityLine);
  const Trajectory read = read_trajectory(path);
  EXPECT_TRUE(read.numbered);
  EXPECT_FALSE(read.has_times);
  EXPECT_EQ(read.poses[1].stamp_ns, 2);
  const Trajectory timed = read_trajectory(path, folder.write("t", "0.5\n0.6\n0.7\n"));
  EXPECT_TRUE(timed.has_times);
  EXPECT_EQ(timed.poses[1].stamp_ns, 700'000'000);
  const std::string two = folder.write("two", "0.5\n0.6\n");
  EXPECT_THAT(message_of([&] { read_trajectory(path, two); }),
              HasSubstr("two: holds 2 times, but"));
  EXPECT_THAT(message_of([&] {
                read_trajectory(folder.write("q", "2 " + kIdentityLine + "2 " + kIdentityLine));
              }),
              HasSubstr("q:2: the number 2 of the frame does not increase"));
}

TEST(Trajectory, OfPositionsAloneIsTakenOnlyWhereTheyAreEnough) {
  const TemporaryFolder folder;
  for (const char* text : {"1 2 3 4\n2 2 3 5\n", "1 2 3 4 0 0 0 0\n2 2 3 5 0 0 0 0\n",
                           "1 2 3 4 nan nan nan nan\n2 2 3 5 nan nan nan nan\n"}) {
    const std::string path = folder.write("p", text);
    const Trajectory read = read_trajectory(path, {}, Orientation::kOptional);
    EXPECT_FALSE(read.has_orientation);
    EXPECT_EQ(read.poses[1].T_world_body->translation(), Eigen::Vector3d(2, 3, 5)) << text;
    EXPECT_THAT(message_of([&] { read_trajectory(path); }), HasSubstr("p:1: has positions alone"));
    EXPECT_THROW(write_trajectory(folder / "out", read, TrajectoryFormat::kTum), ArgumentError);
  }
  const std::string mixed = folder.write("m", "1 2 3 4 0 0 0 1\n2 2 3 5 0 0 0 0\n");
  EXPECT_THAT(message_of([&] { read_trajectory(mixed, {}, Orientation::kOptional); }),
              HasSubstr("m:2: the quaternion has length 0"));
}

TEST(Trajectory, WithTimesWhereFramesAreReadIsRefusedAndTheOtherWayRound) {
  const TemporaryFolder folder;
  const std::string timed = folder.write("timed", "1 0 0 0 0 0 0 1\n");
  const std::string frames = folder.write("frames", kIdentityLine);
  EXPECT_EQ(read_timed_poses(timed).size(), 1u);
  EXPECT_EQ(read_frame_poses(frames).size(), 1u);
  EXPECT_THAT(message_of([&] { read_frame_poses(timed); }), HasSubstr("has times of its own"));
  EXPECT_THAT(message_of([&] { read_timed_poses(frames); }), HasSubstr("without times"));
}

TEST(Trajectory, ThatIsMissingOrEmptyIsRefused) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of([&] { read_trajectory(folder / "none"); }), HasSubstr("none: "));
  const std::string empty = folder.write("empty", "# nothing\n");
  EXPECT_THAT(message_of([&] { read_trajectory(empty); }), HasSubstr("empty: holds no poses"));
  const std::string own = folder.write("own", "1 0 0 0 0 0 0 1\n");
  EXPECT_THROW(read_trajectory(own, own), ArgumentError);
}

Trajectory some_trajectory() {
  Trajectory trajectory;
  Random random(7);
  for (int i = 0; i < 20; ++i) {
    StampedPose pose{1403636579763555527 + std::int64_t{i} * 49999872, std::nullopt};
    if (i != 3 && i != 19) {
      Vector6d xi;
      for (double& v : xi) v = random.uniform(-2, 2);
      pose.T_world_body = SE3::exp(xi).isometry();
    }
    trajectory.poses.push_back(pose);
  }
  return trajectory;
}

TEST(Trajectory, WritesTimesBeforeTheEpochWithTheirSign) {
  const TemporaryFolder folder;
  Trajectory trajectory;
  trajectory.poses = {{-1500000001, Eigen::Isometry3d::Identity()},
                      {-5, Eigen::Isometry3d::Identity()}};
  write_trajectory(folder / "a", trajectory, TrajectoryFormat::kTum);
  const Trajectory read = read_trajectory(folder / "a");
  EXPECT_EQ(read.poses[0].stamp_ns, -1500000001);
  EXPECT_EQ(read.poses[1].stamp_ns, -5);
}

TEST(Trajectory, WithoutTimesOrInDisorderIsNotWritten) {
  const TemporaryFolder folder;
  Trajectory trajectory = some_trajectory();
  trajectory.has_times = false;
  EXPECT_THROW(write_trajectory(folder / "a", trajectory, TrajectoryFormat::kTum), ArgumentError);
  EXPECT_THROW(write_trajectory(folder / "a", trajectory, TrajectoryFormat::kEuroc), ArgumentError);
  trajectory.has_times = true;
  trajectory.poses[2].stamp_ns = trajectory.poses[1].stamp_ns;
  EXPECT_THROW(write_trajectory(folder / "a", trajectory, TrajectoryFormat::kKitti), ArgumentError);
  trajectory = some_trajectory();
  trajectory.poses[5].T_world_body->translation().x() = std::nan("");
  EXPECT_THROW(write_trajectory(folder / "a", trajectory, TrajectoryFormat::kKitti), ArgumentError);
  EXPECT_FALSE(std::filesystem::exists(folder / "a"));
}

TEST(Trajectory, OfKitti00HasAllItsPoses) {
  PLACEGRAPH_DATA_OR_SKIP(path, "golden/KITTI_00_gt.txt");
  EXPECT_EQ(read_trajectory(path).posed(), 4541u);
}

}  // namespace trajectory_file_test
}  // namespace placegraph
