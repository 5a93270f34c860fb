#include <gtest/gtest.h>
#include <placegraph/backend/initialization/certificate.h>
#include <placegraph/backend/pose_graph/initialization_selection.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/synthetic/graphs/graph_world.h>

#include <algorithm>

#include "tests/support/data.h"

namespace placegraph {
namespace pose_graph_starts_test {

using namespace synthetic;

PoseGraphReport optimize_from(const PoseGraph& graph, PoseGraphInitialization start) {
  PoseGraphOptions options;
  options.initialization = start;
  return optimize_pose_graph(graph, options);
}

/// Auto gets as low as the certified start, and that is certified.
template <class Group>
void expect_certified_optimum(const PoseGraph& graph) {
  const PoseGraphReport found = optimize_from(graph, PoseGraphInitialization::kAuto);
  EXPECT_TRUE(found.outcome) << found.outcome.reason;
  const PoseGraphReport certified = optimize_from(graph, PoseGraphInitialization::kCertified);
  EXPECT_LT(found.chi2_final, certified.chi2_final * (1 + 1e-6))
      << to_string(found.initialization_used);
  const ChordalIsotropicCertificate certificate =
      certify_chordal_isotropic(pack<Group>(found.graph), RotationError::kLog);
  EXPECT_TRUE(certificate.certified) << certificate.relative_gap;
}

TEST(PoseGraphStarts, HardWalksAndLongLoopsReachTheirCertifiedOptimum) {
  expect_certified_optimum<SE2>(
      make_manhattan_walk({.poses = 2000, .noise = {.rotation_rad = 0.05}, .seed = 5}));
  expect_certified_optimum<SE2>(make_long_loop({.noise = {.rotation_rad = 0.01}, .seed = 6}));
  expect_certified_optimum<SE3>(make_long_loop(
      {.poses = 1000, .kind = PoseKind::kSE3, .noise = {.rotation_rad = 0.02}, .seed = 7}));
  expect_certified_optimum<SE3>(make_grid_world({.noise = {.rotation_rad = 0.1}, .seed = 8}));
}

TEST(PoseGraphStarts, M3500WithRotationNoiseReachesItsCertifiedOptimum) {
  PLACEGRAPH_DATA_OR_SKIP(path, "posegraphs/M3500.g2o");
  for (const double sigma_rad : {0.1, 0.2, 0.3}) {
    PoseGraph graph = read_g2o(path);
    add_rotation_noise(graph, sigma_rad, 9);
    expect_certified_optimum<SE2>(graph);
  }
}

class ScatteredStart : public testing::TestWithParam<const char*> {};

TEST_P(ScatteredStart, EndsInTheSameOptimumAsTheFile) {
  PLACEGRAPH_DATA_OR_SKIP(path, std::string("posegraphs/") + GetParam() + ".g2o");
  PoseGraph graph = read_g2o(path);
  const double best = optimize_from(graph, PoseGraphInitialization::kAuto).chi2_final;
  disturb_poses(graph, 100, 3);
  const PoseGraphReport scattered = optimize_from(graph, PoseGraphInitialization::kAuto);
  EXPECT_TRUE(scattered.outcome) << scattered.outcome.reason;
  EXPECT_NEAR(scattered.chi2_final, best, 1e-6 * best);
  for (PoseNode& node : graph.nodes)
    node.T_world_node = graph.kind() == PoseKind::kSE2 ? Pose(SE2()) : Pose(SE3());
  EXPECT_NEAR(optimize_from(graph, PoseGraphInitialization::kAuto).chi2_final, best, 1e-6 * best);
}

INSTANTIATE_TEST_SUITE_P(Published, ScatteredStart,
                         testing::Values("intel", "kitti_00", "city10000", "smallGrid3D",
                                         "sphere2500", "torus3D", "parking-garage"),
                         [](const auto& graph) {
                           std::string name = graph.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace pose_graph_starts_test
}  // namespace placegraph
