#include <gtest/gtest.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <sys/wait.h>

#include "tests/support/paths.h"
#include "tests/support/scenes/street_files.h"
#include "tests/support/trajectories.h"

namespace placegraph {
namespace {

using namespace test;

/// Runs an example in a folder; its exit status. What it prints goes to `out`.
int run_example(const std::string& name, const std::string& arguments, const std::string& out) {
  std::ostringstream command;
  command << examples_dir() << "/" << name << " " << arguments << " > " << out << " 2>&1";
  const int status = std::system(command.str().c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Examples, RunFolderWritesATrajectory) {
  const TemporaryFolder folder;
  StreetFiles(folder, 6).write_kitti(true);
  ASSERT_EQ(run_example("run_folder", folder / "s " + (folder / "t.tum"), folder / "out"), 0)
      << read_file(folder / "out");
  const Trajectory trajectory = read_trajectory(folder / "t.tum");
  ASSERT_EQ(trajectory.size(), 6u);
  const SE3 truth = street_T_world_cam(0).inverse() * street_T_world_cam(5);
  EXPECT_LT(distance_m(SE3(*trajectory.poses.back().T_world_body), truth), 0.05);
  EXPECT_THAT(read_file(folder / "out"), testing::HasSubstr("6 of 6 frames posed"));
  EXPECT_EQ(run_example("run_folder", folder / "none " + (folder / "t.tum"), folder / "out"), 2);
  EXPECT_EQ(run_example("run_folder", "", folder / "out"), 2);
}

TEST(Examples, EvaluateTwoNamesTheBetterTrajectory) {
  const TemporaryFolder folder;
  Random random(3);
  const Trajectory truth = winding_drive(150);
  const auto write = [&](const char* name, const Trajectory& trajectory) {
    write_trajectory(folder / name, trajectory, TrajectoryFormat::kTum);
  };
  write("truth.tum", truth);
  write("good.tum", drifting(truth, 0.005, 0.0002, random));
  write("bad.tum", drifting(truth, 0.05, 0.005, random));
  const std::string files = folder / "truth.tum " + (folder / "bad.tum ") + (folder / "good.tum");
  ASSERT_EQ(run_example("evaluate_two", files, folder / "out"), 0) << read_file(folder / "out");
  EXPECT_THAT(read_file(folder / "out"),
              testing::HasSubstr("smaller absolute error: " + (folder / "good.tum")));
  EXPECT_EQ(run_example("evaluate_two", folder / "truth.tum", folder / "out"), 2);
}

TEST(Examples, CustomFactorFindsTheRobotByItsRanges) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_example("custom_factor", "", folder / "out"), 0) << read_file(folder / "out");
  EXPECT_THAT(read_file(folder / "out"),
              testing::ContainsRegex("robot at 2.000 -?0.000 -?0.000 m"));
}

TEST(Examples, OptimizeG2oLowersTheCost) {
  const TemporaryFolder folder;
  folder.write("in.g2o",
               "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1.1 0 0\nVERTEX_SE2 2 2 0.3 0\n"
               "EDGE_SE2 0 1 1 0 0 100 0 0 100 0 400\nEDGE_SE2 1 2 1 0 0 100 0 0 100 0 400\n"
               "EDGE_SE2 0 2 2 0 0 100 0 0 100 0 400\n");
  ASSERT_EQ(run_example("optimize_g2o", folder / "in.g2o " + (folder / "out.g2o"), folder / "out"),
            0)
      << read_file(folder / "out");
  const PoseGraph graph = read_g2o(folder / "out.g2o");
  ASSERT_EQ(graph.nodes.size(), 3u);
  const SE2& last = std::get<SE2>(graph.nodes[2].T_world_node);
  EXPECT_LT((last.translation() - Eigen::Vector2d(2, 0)).norm(), 1e-6);
}

}  // namespace
}  // namespace placegraph
