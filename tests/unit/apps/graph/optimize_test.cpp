#include "apps/graph/optimize.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/pose_graph_file.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/support/output.h"
#include "tests/support/message_of.h"
#include "tests/support/ring.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace optimize_test {

using nlohmann::json;
using test::message_of;
using testing::HasSubstr;

/// Two poses in the plane that four edges of weight 100 relate: two of 1 m and two of 3 m. The best
/// is 2 m, where chi2 is four times 100; at the given 1 m it is twice 400.
PoseGraph torn_pair() {
  PoseGraph graph;
  graph.nodes = {{NodeId(0), SE2(), false}, {NodeId(1), SE2(1, 0, 0), false}};
  for (const double apart_m : {1, 1, 3, 3})
    graph.constraints.emplace_back(test::constraint<SE2>(0, 1, SE2(apart_m, 0, 0)));
  return graph;
}

class OptimizeCommand : public testing::Test {
 protected:
  OptimizeCommand() {
    arguments.in = folder / "in.g2o";
    arguments.out = folder / "out.g2o";
  }
  void expect_refused(const std::string& message) {
    EXPECT_THAT(message_of<ArgumentError>([&] { optimize(arguments); }), HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(arguments.out));
  }
  test::TemporaryFolder folder;
  OptimizeArguments arguments;
};

TEST_F(OptimizeCommand, FindsTheMinimumThatIsComputedByHand) {
  write_g2o(arguments.in, torn_pair());
  const OptimizeResult result = optimize(arguments);
  EXPECT_NEAR(result.before.log, 800, 1e-9);
  EXPECT_NEAR(result.after.log, 400, 1e-6);
  EXPECT_NEAR(result.after.g2o, 400, 1e-6);
  EXPECT_EQ(result.solution.components, 1);
  const PoseGraph written = read_g2o(arguments.out);
  EXPECT_NEAR(std::get<SE2>(written.nodes[1].T_world_node).translation().x() -
                  std::get<SE2>(written.nodes[0].T_world_node).translation().x(),
              2, 1e-6);
  EXPECT_EQ(written.constraints.size(), 4u);
}

TEST_F(OptimizeCommand, ReportsTheSameNumbersAsJson) {
  write_g2o(arguments.in, torn_pair());
  const json report = json::parse(to_json(optimize(arguments)));
  EXPECT_EQ(report["kind"], "SE2");
  EXPECT_EQ(report["nodes"], 2);
  EXPECT_EQ(report["constraints"], 4);
  EXPECT_NEAR(report["chi2_log_initial"].get<double>(), 800, 1e-9);
  EXPECT_NEAR(report["chi2_log"].get<double>(), 400, 1e-6);
  EXPECT_EQ(report["doubtful"], 4);  // chi2 of 100 of each is beyond 16.3, the 99.9 % bound
  EXPECT_EQ(report["rejected"], 0);
  EXPECT_EQ(report["loops_judged"], false);
  EXPECT_FALSE(report.contains("steps"));
}

TEST_F(OptimizeCommand, SaysWhereTheCostLooksLikeThatOfAWrongGraph) {
  write_g2o(arguments.in, torn_pair());
  std::string printed;
  optimize(arguments, [&](LogLevel level, const std::string& message) {
    if (level == LogLevel::kWarning) printed += message;
  });
  EXPECT_THAT(printed,
              HasSubstr("in.g2o: chi2 is 44 times what"));  // 400 / 9: three edges too many
}

TEST_F(OptimizeCommand, SaysNothingOfAGraphThatFits) {
  write_g2o(arguments.in, test::ring<SE3>(12, false));
  std::string printed;
  const OptimizeResult result = optimize(arguments, [&](LogLevel level, const std::string& text) {
    if (level == LogLevel::kWarning) printed += text;
  });
  EXPECT_EQ(printed, "");
  EXPECT_LT(result.after.log, 1e-12);
}

/// A walk with an edge between its first pose and its tenth that is 3 m off.
PoseGraph walk_with_a_false_loop() {
  test::Walk<SE3> walk(20, 0.001);
  PoseGraph graph = walk.graph;
  const SE3 T_from_to =
      walk.truth[0].inverse() * walk.truth[9] * SE3(SO3(), Eigen::Vector3d(0, 3, 0));
  graph.constraints.emplace_back(test::constraint<SE3>(10, 19, T_from_to, 1e6));
  for (Constraint& constraint : graph.constraints)
    std::get<RelativePoseConstraint>(constraint).information =
        Information(Information::Identity(6, 6) * 1e6);
  return graph;
}

TEST_F(OptimizeCommand, LeavesFalseLoopsOutAndDropsThemFromTheFileIfAsked) {
  const PoseGraph graph = walk_with_a_false_loop();
  write_g2o(arguments.in, graph);
  arguments.robust = "gnc";
  const OptimizeResult result = optimize(arguments);
  ASSERT_EQ(result.solution.rejected.size(), 1u);
  EXPECT_EQ(result.solution.rejected[0].constraint, static_cast<int>(graph.constraints.size()) - 1);
  EXPECT_LT(result.after.log, result.before.log);
  EXPECT_EQ(read_g2o(arguments.out).constraints.size(), graph.constraints.size());
  const json report = json::parse(to_json(result));
  EXPECT_EQ(report["rejected_edges"][0]["from"], 10);
  EXPECT_EQ(report["rejected_edges"][0]["to"], 19);
  EXPECT_THAT(to_text(result), HasSubstr("\n  1 constraints rejected\n"));

  arguments.drop_rejected = arguments.force = true;
  optimize(arguments);
  EXPECT_EQ(read_g2o(arguments.out).constraints.size(), graph.constraints.size() - 1);
}

TEST_F(OptimizeCommand, OptimizesTheComponentsEachForItself) {
  PoseGraph graph = torn_pair();
  graph.nodes.push_back({NodeId(5), SE2(9, 9, 0), false});
  graph.nodes.push_back({NodeId(6), SE2(9, 9, 0), false});
  graph.constraints.emplace_back(test::constraint<SE2>(5, 6, SE2(0, 1, 0)));
  write_g2o(arguments.in, graph);
  arguments.task.split = true;
  const OptimizeResult result = optimize(arguments);
  EXPECT_EQ(result.solution.components, 2);
  EXPECT_NEAR(result.after.log, 400, 1e-6);
  EXPECT_THAT(to_text(result), HasSubstr("\n  2 components, each for itself\n"));
}

/// A chain of `surveyed` fixed vertices, and as many fixed ones without edges.
PoseGraph surveyed_chain(int surveyed, std::uint64_t seed) {
  Random random(seed);
  PoseGraph graph;
  for (int i = 0; i < 2 * surveyed; ++i) graph.nodes.push_back({NodeId(i), SE2(i, 0, 0), true});
  for (int i = 0; i + 1 < surveyed; ++i)
    graph.constraints.emplace_back(test::constraint<SE2>(
        i, i + 1, SE2(1, 0, 0) * test::random_element<SE2>(random, 0.1, 0.1)));
  return graph;
}

TEST_F(OptimizeCommand, ExpectsTheErrorsOfSurveyedVerticesAndWarnsOfLargerOnesAlone) {
  arguments.force = arguments.task.split = true;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    for (const double factor : {1.0, 20.0}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed);
      PoseGraph graph = surveyed_chain(50, seed);
      for (Constraint& constraint : graph.constraints)
        std::get<RelativePoseConstraint>(constraint).information *= factor;
      write_g2o(arguments.in, graph);
      std::string printed;
      const OptimizeResult result = optimize(arguments, [&](LogLevel level, const auto& message) {
        if (level == LogLevel::kWarning) printed += message;
      });
      EXPECT_EQ(result.solution.degrees_of_freedom, 3 * 49);
      EXPECT_EQ(result.solution.components, 51);
      EXPECT_EQ(printed.find("it looks like false loops") != std::string::npos, factor > 1)
          << printed;
      EXPECT_EQ(json::parse(to_json(result))["degrees_of_freedom"], 3 * 49);
    }
}

TEST_F(OptimizeCommand, CountsTheStepsOfAGraphThatGrows) {
  write_g2o(arguments.in, test::ring<SE3>(12, false));
  arguments.task.incremental = true;
  const OptimizeResult result = optimize(arguments);
  EXPECT_EQ(result.solution.step_cpu_ms.size(), 12u);
  const json report = json::parse(to_json(result));
  EXPECT_EQ(report["steps"], 12);
  EXPECT_GE(report["step_cpu_ms_max"], report["step_cpu_ms_p95"]);
}

TEST_F(OptimizeCommand, RefusesNamesItDoesNotKnowAndWhatDoesNotGoTogether) {
  write_g2o(arguments.in, torn_pair());
  const OptimizeArguments asked = arguments;
  arguments.cost = "squares";
  expect_refused("--cost: 'squares' is none of log, g2o");
  arguments = asked;
  arguments.robust = "hope";
  expect_refused("--robust: 'hope' is none of none, ");
  arguments = asked;
  arguments.task.incremental = true;
  arguments.engine = "ceres";
  expect_refused("--incremental goes with --engine native");
  arguments = asked;
  arguments.drop_rejected = true;
  expect_refused("--drop-rejected goes with --robust");
}

TEST_F(OptimizeCommand, NamesTheLineOfABrokenFileAndWritesNothing) {
  folder.write("in.g2o", "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 far 0 0\n");
  EXPECT_THAT(message_of([&] { optimize(arguments); }), HasSubstr("in.g2o:2: "));
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
}

TEST_F(OptimizeCommand, KeepsAFileThatIsThereUnlessItIsForced) {
  write_g2o(arguments.in, torn_pair());
  folder.write("out.g2o", "mine");
  EXPECT_THAT(message_of<ArgumentError>([&] { optimize(arguments); }),
              HasSubstr("out.g2o: exists already; --force overwrites it"));
  EXPECT_EQ(test::read_file(arguments.out), "mine");
}

/// A pose that a prior puts at the origin, and a point it sees 2 m ahead that stands 1 m too far.
LandmarkGraph pose_with_a_point() {
  LandmarkGraph graph;
  graph.poses.nodes = {{NodeId(0), SE3(), false}};
  graph.priors.push_back({NodeId(0), SE3(), test::isotropic<SE3>(100)});
  graph.points.push_back({NodeId(7), {3, 0, 0}});
  graph.observations.push_back(
      {NodeId(0), NodeId(7), {2, 0, 0}, 100 * Eigen::Matrix3d::Identity()});
  return graph;
}

TEST_F(OptimizeCommand, PlacesPointLandmarks) {
  write_g2o(arguments.in, pose_with_a_point());
  const OptimizeResult result = optimize(arguments);
  ASSERT_TRUE(result.landmarks);
  EXPECT_NEAR(result.landmarks->chi2_log_initial, 100, 1e-9);
  EXPECT_NEAR(result.landmarks->chi2_log, 0, 1e-9);
  EXPECT_EQ(result.landmarks->components, 1);
  const LandmarkGraph written = read_landmark_graph(arguments.out);
  EXPECT_NEAR(written.points[0].position_world.x() -
                  std::get<SE3>(written.poses.nodes[0].T_world_node).translation().x(),
              2, 1e-6);
  const json report = json::parse(to_json(result));
  EXPECT_EQ(report["landmarks"], 1);
  EXPECT_EQ(report["priors"], 1);
  EXPECT_EQ(report["in"], arguments.in);
  EXPECT_THAT(to_text(result), HasSubstr("1 landmarks seen 1 times"));
}

TEST_F(OptimizeCommand, RefusesOfLandmarksWhatBelongsToPosesAlone) {
  write_g2o(arguments.in, pose_with_a_point());
  arguments.task.certify = true;
  expect_refused("has priors or point landmarks, which --certify does not take");
  arguments.task.certify = false;
  arguments.robust = "gnc";
  expect_refused("has priors or point landmarks, which --robust gnc does not take");
}

TEST_F(OptimizeCommand, GivesTheCostOfTheSameConstraintsBeforeAndAfter) {
  write_g2o(arguments.in, walk_with_a_false_loop());
  arguments.robust = "auto";
  const OptimizeResult result = optimize(arguments);
  ASSERT_EQ(result.solution.rejected.size(), 1u);
  const PoseGraph kept = without_rejected(read_g2o(arguments.in), result.solution.rejected);
  EXPECT_NEAR(result.before.log, chi2(kept, RotationError::kLog), 1e-9 * result.before.log);
  EXPECT_NEAR(result.before.g2o, chi2(kept, RotationError::kQuaternion), 1e-9 * result.before.g2o);
  EXPECT_LE(result.after.log, result.before.log);
}

}  // namespace optimize_test
}  // namespace placegraph::apps
