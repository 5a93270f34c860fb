#include <placegraph/graph/core/random.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace trajectory_file_test {

using test::read_file;
using test::TemporaryFolder;

Trajectory random_trajectory(std::uint64_t seed) {
  Trajectory trajectory;
  Random random(seed);
  for (int i = 0; i < 20; ++i) {
    StampedPose pose{1403636579763555527 + std::int64_t{i} * 49999872, std::nullopt};
    if (random.index(6) != 0) {
      Vector6d xi;
      for (double& v : xi) v = random.uniform(-2, 2);
      pose.T_world_body = SE3::exp(xi).isometry();
    }
    trajectory.poses.push_back(pose);
  }
  return trajectory;
}

/// Half a step of the last digit written: 9 digits of metres, 12 of rotation entries.
void expect_same_pose(const StampedPose& a, const StampedPose& b) {
  ASSERT_TRUE(a.T_world_body && b.T_world_body);
  const Eigen::Matrix4d difference = a.T_world_body->matrix() - b.T_world_body->matrix();
  EXPECT_LT((difference.topRightCorner<3, 1>().cwiseAbs().maxCoeff()), 0.51e-9);
  EXPECT_LT((difference.topLeftCorner<3, 3>().cwiseAbs().maxCoeff()), 1e-11);
}

TEST(Trajectory, IsTheSameAfterWritingAndReadingInKittiForm) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const TemporaryFolder folder;
    const Trajectory written = random_trajectory(seed);
    write_trajectory(folder / "a", written, TrajectoryFormat::kKitti);
    const Trajectory read = read_trajectory(folder / "a");
    ASSERT_EQ(read.size(), written.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
      ASSERT_EQ(read.poses[i].T_world_body.has_value(), written.poses[i].T_world_body.has_value());
      if (written.poses[i].T_world_body) expect_same_pose(read.poses[i], written.poses[i]);
    }
    write_trajectory(folder / "b", read, TrajectoryFormat::kKitti);
    EXPECT_EQ(read_file(folder / "a"), read_file(folder / "b"));
  }
}

TEST(Trajectory, IsTheSameLessItsLostFramesInTumAndEurocForm) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Trajectory written = random_trajectory(seed);
    for (const TrajectoryFormat format : {TrajectoryFormat::kTum, TrajectoryFormat::kEuroc}) {
      const TemporaryFolder folder;
      write_trajectory(folder / "a", written, format);
      const Trajectory read = read_trajectory(folder / "a");
      ASSERT_EQ(read.size(), written.posed());
      std::size_t i = 0;
      for (const StampedPose& pose : written.poses) {
        if (!pose.T_world_body) continue;
        EXPECT_EQ(read.poses[i].stamp_ns, pose.stamp_ns);
        expect_same_pose(read.poses[i++], pose);
      }
    }
  }
}

}  // namespace trajectory_file_test
}  // namespace placegraph
