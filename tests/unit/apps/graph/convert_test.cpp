#include "apps/graph/convert.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <filesystem>

#include "tests/support/message_of.h"
#include "tests/support/scenes/pose_walk.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/trajectories.h"

namespace placegraph::apps {
namespace convert_test {

using test::message_of;
using testing::HasSubstr;

class ConvertCommand : public testing::Test {
 protected:
  /// Five frames without times, the third of which is lost.
  void write_poses(const std::string& name) {
    Trajectory drive = test::winding_drive(5, 1, false);
    drive.poses[2].T_world_body.reset();
    write_trajectory(folder / name, drive, TrajectoryFormat::kKitti);
  }
  ConvertArguments from_to(const std::string& in, const std::string& out) {
    ConvertArguments arguments;
    arguments.in = folder / in;
    arguments.out = folder / out;
    return arguments;
  }
  void expect_refused(const ConvertArguments& arguments, const std::string& message) {
    EXPECT_THAT(message_of<ArgumentError>([&] { convert(arguments); }), HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(arguments.out));
  }
  test::TemporaryFolder folder;
};

TEST_F(ConvertCommand, GivesATrajectoryItsTimes) {
  write_poses("poses.txt");
  ConvertArguments arguments = from_to("poses.txt", "poses.tum");
  arguments.times = folder.write("times.txt", "0\n0.5\n1\n1.5\n2\n");
  const ConvertResult result = convert(arguments);
  EXPECT_EQ(result.kind, ConvertResult::Kind::kTrajectory);
  EXPECT_EQ(result.frames, 5u);
  EXPECT_EQ(result.posed, 4u);
  EXPECT_EQ(result.left_out, 0u);
  const Trajectory written = read_trajectory(arguments.out);
  ASSERT_EQ(written.size(), 4u);  // this form has no lines of lost frames
  EXPECT_EQ(written.poses[3].stamp_ns, 2'000'000'000);
}

TEST_F(ConvertCommand, LeavesOutFramesWithoutAPoseIfAsked) {
  write_poses("poses.txt");
  ConvertArguments arguments = from_to("poses.txt", "posed.txt");
  arguments.posed_only = true;
  const ConvertResult result = convert(arguments);
  EXPECT_EQ(result.frames, 4u);
  EXPECT_EQ(result.left_out, 1u);
  EXPECT_EQ(read_trajectory(arguments.out).size(), 4u);
  EXPECT_EQ(to_text(result), arguments.in +
                                 ": 4 poses of 4 frames (1 frames left out), written to " +
                                 arguments.out + "\n");
}

TEST_F(ConvertCommand, LeavesOutFramesThatAnotherTrajectoryHasNoPoseFor) {
  write_poses("estimate.txt");
  write_trajectory(folder / "truth.txt", test::winding_drive(5, 1, false),
                   TrajectoryFormat::kKitti);
  ConvertArguments arguments = from_to("truth.txt", "kept.txt");
  arguments.posed_in = folder / "estimate.txt";
  EXPECT_EQ(convert(arguments).left_out, 1u);
  const Trajectory truth = read_trajectory(arguments.in), kept = read_trajectory(arguments.out);
  ASSERT_EQ(kept.size(), 4u);
  EXPECT_TRUE(kept.poses[2].T_world_body->isApprox(*truth.poses[3].T_world_body));
}

TEST_F(ConvertCommand, RefusesATrajectoryOfAnotherLength) {
  write_poses("estimate.txt");
  write_trajectory(folder / "truth.txt", test::winding_drive(6, 1, false),
                   TrajectoryFormat::kKitti);
  ConvertArguments arguments = from_to("truth.txt", "kept.txt");
  arguments.posed_in = folder / "estimate.txt";
  expect_refused(arguments, "estimate.txt has 5 frames, ");
}

TEST_F(ConvertCommand, WritesThePosesOfAGraphInTheOrderOfTheirIds) {
  PoseGraph graph = test::Walk<SE3>(6, 0.01).graph;
  std::reverse(graph.nodes.begin(), graph.nodes.end());
  write_g2o(folder / "graph.g2o", graph);
  const ConvertResult result = convert(from_to("graph.g2o", "poses.kitti"));
  EXPECT_EQ(result.kind, ConvertResult::Kind::kPosesOfGraph);
  EXPECT_EQ(result.nodes, 6u);
  const Trajectory written = read_trajectory(folder / "poses.kitti");
  ASSERT_EQ(written.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_TRUE(written.poses[i].T_world_body->isApprox(
        std::get<SE3>(graph.nodes[5 - i].T_world_node).isometry(), 1e-9))
        << i;
}

TEST_F(ConvertCommand, MakesSimilaritiesRigidIfAsked) {
  write_g2o(folder / "sim.g2o", test::Walk<Sim3>(6, 0.01).graph);
  ConvertArguments arguments = from_to("sim.g2o", "rigid.g2o");
  const ConvertResult kept = convert(arguments);
  EXPECT_EQ(read_g2o(arguments.out).kind(), PoseKind::kSim3);
  arguments.rigid = arguments.force = true;
  const ConvertResult result = convert(arguments);
  EXPECT_EQ(read_g2o(arguments.out).kind(), PoseKind::kSE3);
  EXPECT_EQ(result.constraints, kept.constraints);
}

TEST_F(ConvertCommand, RefusesWhatTheFormCannotHold) {
  write_poses("poses.txt");
  write_g2o(folder / "graph.g2o", test::Walk<SE3>(6, 0.01).graph);
  expect_refused(from_to("poses.txt", "out.g2o"), "which does not become a pose graph");
  expect_refused(from_to("poses.txt", "out.tum"), "has no times, which ");
  expect_refused(from_to("graph.g2o", "out.tum"), "is a pose graph; its poses have no times");
  expect_refused(from_to("poses.txt", "out.xyz"), "the extension is not that of a known form");
  ConvertArguments rigid = from_to("poses.txt", "out.txt");
  rigid.rigid = true;
  expect_refused(rigid, "--rigid: ");
  ConvertArguments timed = from_to("graph.g2o", "out.kitti");
  timed.times = folder / "times.txt";
  expect_refused(timed, "--times: a pose graph has none");
  ConvertArguments named = from_to("poses.txt", "out.txt");
  named.to = "toro";
  expect_refused(named, "--to: 'toro' is none of kitti, tum, euroc, g2o");
}

TEST_F(ConvertCommand, AppliesAFilter) {
  write_trajectory(folder / "in.tum", test::winding_drive(50), TrajectoryFormat::kTum);
  ConvertArguments arguments = from_to("in.tum", "out.tum");
  arguments.apply = "crop 1:3; downsample 5";
  const ConvertResult result = convert(arguments);
  EXPECT_EQ(result.frames, 5u);
  EXPECT_EQ(result.left_out, 45u);
  const Trajectory written = read_trajectory(arguments.out);
  EXPECT_EQ(written.poses[0].stamp_ns, 1'000'000'000);
  arguments.out = folder / "none.tum";
  arguments.apply = "crop 1:3; turn";
  expect_refused(arguments, "step 2 (turn): 'turn' is none of crop, ");
  arguments.apply = "crop 90:";
  EXPECT_THAT(message_of<NoResult>([&] { convert(arguments); }),
              HasSubstr("leaves no pose of 50 frames"));
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
}

TEST_F(ConvertCommand, MergesWhatItHasSplit) {
  Trajectory drive = test::winding_drive(60);
  for (std::size_t i = 20; i < 30; ++i) drive.poses[i].T_world_body.reset();
  write_trajectory(folder / "in.tum", drive, TrajectoryFormat::kTum);
  for (const auto& [split, files] : {std::pair{"gaps", 2}, {"2s", 3}, {"0.5s", 10}}) {
    SCOPED_TRACE(split);
    ConvertArguments parts = from_to("in.tum", std::string(split) + "/part.tum");
    std::filesystem::create_directories(folder / split);
    parts.split = split;
    const ConvertResult result = convert(parts);
    ASSERT_EQ(static_cast<int>(result.parts.size()), files);
    EXPECT_EQ(std::filesystem::path(result.parts[0]).filename(),
              files < 10 ? "part_1.tum" : "part_01.tum");
    EXPECT_FALSE(std::filesystem::exists(parts.out));
    ConvertArguments whole = from_to("in.tum", std::string(split) + "/whole.tum");
    whole.in = result.parts.back();
    whole.merge.assign(result.parts.begin(), result.parts.end() - 1);
    EXPECT_EQ(convert(whole).frames, 50u);
    // Quaternions are computed anew from matrices, to the last of twelve digits.
    const Trajectory merged = read_trajectory(whole.out), before = read_trajectory(folder / "in.tum");
    ASSERT_EQ(merged.size(), before.size());
    for (std::size_t i = 0; i < merged.size(); ++i) {
      EXPECT_EQ(merged.poses[i].stamp_ns, before.poses[i].stamp_ns);
      EXPECT_TRUE(merged.poses[i].T_world_body->isApprox(*before.poses[i].T_world_body, 1e-11));
    }
  }
}

TEST_F(ConvertCommand, RefusesOverlapsUnlessToldWhatToKeep) {
  write_trajectory(folder / "a.tum", test::winding_drive(50), TrajectoryFormat::kTum);
  ConvertArguments arguments = from_to("a.tum", "out.tum");
  arguments.merge = {folder / "a.tum"};
  expect_refused(arguments, "--merge: merge: a trajectory begins at 0 ns, before the end of an "
                            "earlier one at 4900000000 ns; --overlap keeps");
  arguments.overlap = true;
  EXPECT_EQ(convert(arguments).left_out, 50u);
  write_poses("poses.txt");
  ConvertArguments untimed = from_to("poses.txt", "other.tum");
  untimed.merge = {folder / "a.tum"};
  expect_refused(untimed, "has no times; give them with --times");
}

TEST_F(ConvertCommand, WritesAllPartsOrNone) {
  write_trajectory(folder / "in.tum", test::winding_drive(60), TrajectoryFormat::kTum);
  folder.write("out_2.tum", "mine\n");
  ConvertArguments arguments = from_to("in.tum", "out.tum");
  arguments.split = "2s";
  expect_refused(arguments, "out_2.tum");
  EXPECT_FALSE(std::filesystem::exists(folder / "out_1.tum"));
  EXPECT_EQ(test::read_file(folder / "out_2.tum"), "mine\n");
  arguments.split = "2 hours";
  expect_refused(arguments, "--split: '2 hours' is neither gaps nor a length of time, as 60s");
}

TEST(ConvertText, CountsWhatAGraphHas) {
  ConvertResult result;
  result.kind = ConvertResult::Kind::kGraph;
  result.in = "a.graph", result.out = "a.g2o";
  result.nodes = 3, result.constraints = 4;
  EXPECT_EQ(to_text(result), "a.graph: 3 nodes, 4 constraints, written to a.g2o\n");
  result.poses_alone = false;
  result.priors = 1, result.landmarks = 2, result.observations = 5;
  EXPECT_EQ(to_text(result),
            "a.graph: 3 nodes, 4 constraints, 1 priors, 2 landmarks seen 5 times, written to "
            "a.g2o\n");
  result.kind = ConvertResult::Kind::kPosesOfGraph;
  EXPECT_EQ(to_text(result),
            "a.graph: 3 poses in the order of their ids (2 landmarks left out), written to "
            "a.g2o\n");
}

}  // namespace convert_test
}  // namespace placegraph::apps
