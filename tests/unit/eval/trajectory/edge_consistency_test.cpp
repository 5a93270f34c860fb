#include <gtest/gtest.h>
#include <placegraph/eval/internal/trajectory/edge_consistency.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/internal/core/random.h>

namespace placegraph {
namespace {

const SE3 kStep(SO3::exp({0.1, -0.2, 0.3}), Eigen::Vector3d(1, 2, 3));

std::map<NodeId, SE3> chain(int nodes) {
  std::map<NodeId, SE3> truth;
  SE3 T(SO3::exp({1, 0.5, -0.2}), Eigen::Vector3d(7, 0, -4));
  for (int i = 0; i < nodes; ++i, T = T * kStep) truth[NodeId(i)] = T;
  return truth;
}

RelativePoseConstraint edge(std::int64_t from, const Vector6d& error, double sigma) {
  RelativePoseConstraint constraint;
  constraint.from = NodeId(from);
  constraint.to = NodeId(from + 1);
  constraint.T_from_to = kStep * SE3::exp(error).inverse();
  constraint.information = Information::Identity(6, 6) / (sigma * sigma);
  return constraint;
}

TEST(EdgeConsistency, OfKnownErrorsIsTheirSquareOverTheDegreesOfFreedom) {
  Vector6d error = Vector6d::Zero();
  error[1] = 0.3;
  const auto result = edge_consistency(
      {edge(0, Vector6d::Zero(), 0.1), edge(1, error, 0.1), edge(2, error, 0.05)}, chain(4));
  EXPECT_EQ(result.edges, 3);
  EXPECT_EQ(result.unknown, 0);
  EXPECT_NEAR(result.mean_nees, (0 + 9.0 / 6 + 36.0 / 6) / 3, 1e-9);
  EXPECT_NEAR(result.median_nees, 9.0 / 6, 1e-9);
  EXPECT_NEAR(result.share_beyond_99, 1.0 / 3, 1e-12);  // chi^2 of 36 beyond 16.8
}

TEST(EdgeConsistency, IsOneWhereClaimsAreRight) {
  Random random(4);
  std::vector<RelativePoseConstraint> edges;
  constexpr int kEdges = 2000;
  for (int i = 0; i < kEdges; ++i) {
    Vector6d error;
    for (int k = 0; k < 6; ++k) error[k] = random.normal(0, 0.01);
    edges.push_back(edge(i, error, 0.01));
  }
  const auto result = edge_consistency(edges, chain(kEdges + 1));
  EXPECT_NEAR(result.mean_nees, 1, 0.05);
  EXPECT_NEAR(result.median_nees, 5.348 / 6, 0.05);  // median of chi^2 over six
  EXPECT_NEAR(result.share_beyond_99, 0.01, 0.007);
}

TEST(EdgeConsistency, LeavesOutEdgesOfUnknownTruthAndRefusesOthersThanRigidOnes) {
  auto truth = chain(3);
  truth.erase(NodeId(2));
  const auto result =
      edge_consistency({edge(0, Vector6d::Zero(), 1), edge(1, Vector6d::Zero(), 1)}, truth);
  EXPECT_EQ(result.edges, 1);
  EXPECT_EQ(result.unknown, 1);
  EXPECT_EQ(edge_consistency({}, truth).edges, 0);
  RelativePoseConstraint similar = edge(0, Vector6d::Zero(), 1);
  similar.T_from_to = Sim3();
  similar.information = Information::Identity(7, 7);
  EXPECT_THROW((void)edge_consistency({similar}, truth), ArgumentError);
}

}  // namespace
}  // namespace placegraph
