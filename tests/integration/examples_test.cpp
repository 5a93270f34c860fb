#include <gtest/gtest.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/synthetic/graphs/graph_world.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <sys/wait.h>

#include "tests/support/paths.h"
#include "tests/support/scenes/street_files.h"
#include "tests/support/trajectories.h"

namespace placegraph {
namespace examples_test {

using namespace test;

/// Runs an example in a folder; its exit status. What it prints goes to `out`.
int run_example(const std::string& name, const std::string& arguments, const std::string& out) {
  std::ostringstream command;
  command << "'" << examples_dir() << "/" << name << "' " << arguments << " > " << out << " 2>&1";
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

TEST(Examples, OwnImagesMoveAlongTheWall) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_example("own_images", "", folder / "out"), 0) << read_file(folder / "out");
  // 39 steps of 10 px at 4 m and 400 px of focal length.
  double moved = 0;
  int keyframes = 0;
  ASSERT_EQ(std::sscanf(read_file(folder / "out").c_str(), "moved %lf m to the right, %d", &moved,
                        &keyframes),
            2);
  EXPECT_NEAR(moved, 3.9, 0.01);
  EXPECT_GT(keyframes, 3);
}

TEST(Examples, JudgeRecognizerFindsTheSecondRound) {
  const TemporaryFolder folder;
  // Two rounds of pictures: the second is the first again.
  constexpr int kRound = 24;
  const StreetFiles street(folder, 8);
  std::ostringstream poses;
  for (int i = 0; i < 2 * kRound; ++i) {
    const int path = i % kRound, shown = path < 8 ? path : path < 16 ? 7 : 23 - path;
    std::ostringstream name;
    name << "s/image_0/" << std::setw(6) << std::setfill('0') << i << ".png";
    write_image(folder, name.str(), street.left(shown));
    poses << "1 0 0 0 0 1 0 0 0 0 1 " << 10 * path << "\n";
  }
  street.write_kitti(false);
  folder.write("s/poses.txt", poses.str());
  ASSERT_EQ(run_example("judge_recognizer", folder / "s", folder / "out"), 0)
      << read_file(folder / "out");
  EXPECT_THAT(read_file(folder / "out"), testing::HasSubstr("24 images show a place again"));
  EXPECT_EQ(run_example("judge_recognizer", folder / "none", folder / "out"), 2);
}

TEST(Examples, WatchEventsTellsOfKeyframes) {
  const TemporaryFolder folder;
  StreetFiles(folder, 6).write_kitti(true);
  ASSERT_EQ(run_example("watch_events", folder / "s", folder / "out"), 0)
      << read_file(folder / "out");
  EXPECT_THAT(read_file(folder / "out"), testing::StartsWith("frame 0 is keyframe 0 of place 0\n"));
  EXPECT_THAT(read_file(folder / "out"),
              testing::ContainsRegex("[0-9]+ keyframes in [0-9]+ places"));
}

TEST(Examples, GeoreferenceMapWritesKml) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_example("georeference_map", folder / "block.kml", folder / "out"), 0)
      << read_file(folder / "out");
  EXPECT_THAT(read_file(folder / "block.kml"), testing::HasSubstr("<kml"));
  double latitude = 0, longitude = 0, off = 1;
  ASSERT_EQ(std::sscanf(read_file(folder / "out").c_str(), "origin %lf N %lf E, fixes off by %lf m",
                        &latitude, &longitude, &off),
            3);
  EXPECT_NEAR(latitude, 49, 0.01);
  EXPECT_NEAR(longitude, 8.4, 0.01);
  EXPECT_LT(off, 0.1);
  EXPECT_EQ(run_example("georeference_map", "/nonexistent/a.kml", folder / "out"), 2);
}

TEST(Examples, ResumeRunGoesOnAfterAnInterruption) {
  const TemporaryFolder folder;
  StreetFiles(folder, 9).write_kitti(true);
  const std::string arguments = folder / "s " + (folder / "map.db");
  ASSERT_EQ(run_example("resume_run", arguments + " 6", folder / "out"), 1)
      << read_file(folder / "out");
  ASSERT_EQ(run_example("resume_run", arguments, folder / "out"), 0) << read_file(folder / "out");
  EXPECT_THAT(read_file(folder / "out"), testing::HasSubstr("went on with frame"));
  EXPECT_THAT(read_file(folder / "out"), testing::HasSubstr("9 of 9 frames posed"));
}

TEST(Examples, OptimizeG2oNamesAFalseLoop) {
  const TemporaryFolder folder;
  synthetic::ManhattanWalkOptions options;
  options.poses = 300;
  PoseGraph graph = synthetic::make_manhattan_walk(options);
  const std::size_t good = graph.constraints.size();
  synthetic::add_false_loops(graph, 2, 1);
  write_g2o(folder / "in.g2o", graph);
  ASSERT_EQ(run_example("optimize_g2o", folder / "in.g2o " + (folder / "out.g2o"), folder / "out"),
            0)
      << read_file(folder / "out");
  const std::string message = read_file(folder / "out");
  for (std::size_t i = good; i < graph.constraints.size(); ++i) {
    const auto& loop = std::get<RelativePoseConstraint>(graph.constraints[i]);
    EXPECT_THAT(message, testing::HasSubstr("false loop from " + to_string(loop.from) + " to " +
                                            to_string(loop.to)));
  }
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

}  // namespace examples_test
}  // namespace placegraph
