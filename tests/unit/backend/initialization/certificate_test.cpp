#include <gtest/gtest.h>
#include <placegraph/backend/initialization/certificate_matrix.h>
#include <placegraph/backend/initialization/certified_initialization.h>
#include <placegraph/backend/initialization/initialization.h>
#include <placegraph/backend/initialization/certificate.h>
#include <placegraph/backend/pose_graph/initialization_selection.h>

#include <limits>

#include "tests/support/ring.h"

namespace placegraph {
namespace certificate_test {

using test::ring;
using test::Walk;

template <class Group>
ChordalIsotropicCertificate certificate_of(const PackedGraph<Group>& graph) {
  return certify_chordal_isotropic(graph, RotationError::kLog);
}

template <class Group>
class CertificateOf : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(CertificateOf, Groups);

TYPED_TEST(CertificateOf, AnExactGraphIsCertifiedAtItsTruth) {
  const Walk<TypeParam> walk(30, 0);
  PackedGraph<TypeParam> graph = pack<TypeParam>(walk.graph);
  graph.poses = walk.truth;
  const ChordalIsotropicCertificate certificate = certificate_of(graph);
  EXPECT_TRUE(certificate.certified);
  EXPECT_LT(certificate.cost, 1e-12);
  EXPECT_GT(certificate.smallest_eigenvalue, -1e-9 * certificate.eigenvalue_scale);
}

TYPED_TEST(CertificateOf, ANoisyGraphIsCertifiedNearItsMinimum) {
  const Walk<TypeParam> walk(30, 0.05);
  PackedGraph<TypeParam> graph = pack<TypeParam>(walk.graph);
  chordal_initialization(graph);
  const ChordalIsotropicCertificate certificate = certificate_of(graph);
  EXPECT_TRUE(certificate.certified) << certificate.relative_gap;
  EXPECT_GT(certificate.cost, 1);
  EXPECT_LE(certificate.lower_bound, certificate.cost);
  EXPECT_GE(certificate.cost_of_estimate, certificate.cost);
}

TYPED_TEST(CertificateOf, AWoundRingIsNoMinimumToCertify) {
  const PackedGraph<TypeParam> wound = pack<TypeParam>(ring<TypeParam>(12, true));
  const ChordalIsotropicCertificate certificate = certificate_of(wound);
  EXPECT_FALSE(certificate.certified);
  EXPECT_GT(certificate.cost, 1);
  EXPECT_LT(certificate.smallest_eigenvalue, -1e-3 * certificate.eigenvalue_scale);
  // The bound is a bound all the same: the unwound ring costs nothing.
  EXPECT_LT(certificate.lower_bound, 1e-9);
  EXPECT_TRUE(certificate_of(pack<TypeParam>(ring<TypeParam>(12, false))).certified);
}

TYPED_TEST(CertificateOf, SeveralHeldNodesBelongToWhatIsCertified) {
  const Walk<TypeParam> walk(30, 0);
  PoseGraph held = walk.graph;
  for (const int i : {0, 10, 20}) {
    held.nodes[i].fixed = true;
    held.nodes[i].T_world_node = walk.truth[i];
  }
  PackedGraph<TypeParam> graph = pack<TypeParam>(held);
  graph.poses = walk.truth;
  const ChordalIsotropicCertificate exact = certificate_of(graph);
  EXPECT_TRUE(exact.certified);
  EXPECT_LT(exact.cost, 1e-12);
  // One of them half a metre off: free, the graph would cost nothing; held, it cannot.
  typename TypeParam::Tangent aside = TypeParam::Tangent::Zero();
  aside[0] = 0.5;
  graph.poses[10] = graph.poses[10] * TypeParam::exp(aside);
  LocalSolver<TypeParam> solver({});
  ASSERT_TRUE(solver.solve(graph).outcome);
  const ChordalIsotropicCertificate bent = certificate_of(graph);
  EXPECT_TRUE(bent.certified) << bent.relative_gap;
  EXPECT_GT(bent.lower_bound, 1);
  EXPECT_LE(bent.lower_bound, bent.cost_of_estimate);
}

TYPED_TEST(CertificateOf, WhatIsNotFiniteIsNotCertifiedAndEnds) {
  const Walk<TypeParam> walk(10, 0.05);
  PackedGraph<TypeParam> graph = pack<TypeParam>(walk.graph);
  typename TypeParam::Tangent xi = TypeParam::Tangent::Zero();
  xi[0] = std::numeric_limits<double>::quiet_NaN();
  graph.poses[4] = graph.poses[4] * TypeParam::exp(xi);
  const ChordalIsotropicCertificate certificate = certificate_of(graph);
  EXPECT_FALSE(certificate.certified);
  EXPECT_EQ(certificate.relative_gap, 1);
}

TEST(CertificateMatrix, OfMultipliersThatAreNotFiniteProvesNothing) {
  const PackedGraph<SE2> graph = pack<SE2>(ring<SE2>(5, false));
  const IsotropicProblem<2> problem = isotropic_problem(graph, RotationError::kLog);
  std::vector<std::pair<int, int>> edges;
  for (const auto& edge : problem.edges) edges.emplace_back(edge.from, edge.to);
  const BlockOrdering ordering = order_blocks(problem.nodes, 3, edges);
  CertificateMatrix<2>::Multipliers multipliers(5, Eigen::Matrix2d::Zero());
  multipliers[2](0, 0) = std::numeric_limits<double>::quiet_NaN();
  CertificateMatrix<2> matrix(problem, ordering, multipliers);
  EXPECT_FALSE(matrix.positive_with(1));
  const auto curvature = matrix.curvature(0);
  EXPECT_EQ(curvature.shift, std::numeric_limits<double>::infinity());
  EXPECT_EQ(curvature.smallest_eigenvalue, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(matrix.relative_gap(1, matrix.lower_bound(curvature.shift)), 1);
}

TYPED_TEST(CertificateOf, NoStartEndsBelowTheBound) {
  // So noisy that minima abound.
  const Walk<TypeParam> walk(8, 0.8);
  PackedGraph<TypeParam> graph = pack<TypeParam>(walk.graph);
  Random random(11);
  double lowest = std::numeric_limits<double>::infinity(), highest_bound = 0;
  for (int start = 0; start < 12; ++start) {
    for (std::size_t i = 1; i < graph.poses.size(); ++i)
      graph.poses[i] =
          walk.truth[i] * test::random_element<TypeParam>(random, start * 0.3, start * 0.3);
    if constexpr (TypeParam::kDof == 7)  // the scales belong to the problem, not to its unknowns
      for (TypeParam& pose : graph.poses) pose = Sim3(pose.rotation(), pose.translation(), 1);
    const ChordalIsotropicCertificate certificate = certificate_of(graph);
    lowest = std::min(lowest, certificate.cost);
    highest_bound = std::max(highest_bound, certificate.lower_bound);
  }
  EXPECT_LE(highest_bound, lowest * (1 + 1e-9));
}

TYPED_TEST(CertificateOf, TheCertifiedStartUnwindsARing) {
  for (const int n : {6, 30}) {
    PackedGraph<TypeParam> graph = pack<TypeParam>(ring<TypeParam>(n, true));
    const TypeParam first = graph.poses[0];
    const CertifiedInitializationReport report = initialize_certified(graph);
    EXPECT_TRUE(report.tight);
    EXPECT_GT(report.rank, kSpaceDim<TypeParam>);
    EXPECT_LT(robust_cost(graph, RotationError::kLog), 1e-6);
    EXPECT_EQ(graph.poses[0].matrix(), first.matrix());
  }
}

TYPED_TEST(CertificateOf, TheCertifiedStartKeepsHeldNodesAndComponentsWhereTheyAre) {
  const Walk<TypeParam> walk(16, 0);
  PoseGraph both = walk.graph;
  for (const int i : {2, 9}) {
    both.nodes[i].fixed = true;
    both.nodes[i].T_world_node = walk.truth[i];
  }
  for (PoseNode node : ring<TypeParam>(8, true).nodes) {
    node.id = NodeId(node.id.value() + 100);
    both.nodes.push_back(node);
  }
  for (const Constraint& c : ring<TypeParam>(8, true).constraints) {
    auto moved = std::get<RelativePoseConstraint>(c);
    moved.from = NodeId(moved.from.value() + 100);
    moved.to = NodeId(moved.to.value() + 100);
    both.constraints.emplace_back(moved);
  }
  PackedGraph<TypeParam> graph = pack<TypeParam>(both);
  chordal_initialization(graph);  // for the scales, which the certified start takes as they are
  EXPECT_TRUE(initialize_certified(graph).tight);
  for (std::size_t i = 0; i < walk.truth.size(); ++i)
    EXPECT_LT(test::difference(graph.poses[i], walk.truth[i]), 1e-5);
  EXPECT_EQ(graph.poses[16].matrix(), TypeParam().matrix());
}

TYPED_TEST(CertificateOf, AMinimumIsCertifiedAsItIsUnlessItIsWound) {
  for (const bool wound : {false, true}) {
    PackedGraph<TypeParam> graph = pack<TypeParam>(ring<TypeParam>(40, wound));
    EXPECT_EQ(certified_as_they_are(graph), !wound);
  }
  const Walk<TypeParam> walk(40, 0.05);
  PackedGraph<TypeParam> graph = pack<TypeParam>(walk.graph);
  LocalSolver<TypeParam> solver({});
  ASSERT_TRUE(solver.solve(graph).outcome);
  EXPECT_TRUE(certified_as_they_are(graph));
  graph.edges.clear();
  EXPECT_TRUE(certified_as_they_are(graph));
}

TYPED_TEST(CertificateOf, WindingsAreSettledAtTheTruthAndNotAtAWoundMinimum) {
  for (const double scale : {1e-6, 1.0, 1e6}) {  // of the information
    for (const bool wound : {false, true}) {
      PackedGraph<TypeParam> graph = pack<TypeParam>(ring<TypeParam>(40, wound));
      for (auto& edge : graph.edges) edge.information *= scale;
      EXPECT_EQ(windings_are_settled(graph), !wound);
    }
    Walk<TypeParam> walk(40, 0.05);
    PackedGraph<TypeParam> graph = pack<TypeParam>(walk.graph);
    for (auto& edge : graph.edges) edge.information *= scale;
    graph.poses = walk.truth;
    EXPECT_TRUE(windings_are_settled(graph));
  }
}

TYPED_TEST(CertificateOf, AutoLeavesAWoundMinimumAndSaysHow) {
  LocalSolver<TypeParam> solver({});
  PackedGraph<TypeParam> graph = pack<TypeParam>(ring<TypeParam>(40, true));
  const InitializedSolution found =
      solve_from_initialization(graph, PoseGraphInitialization::kAuto, RotationError::kLog, solver);
  EXPECT_TRUE(found.solution.outcome) << found.solution.outcome.reason;
  EXPECT_LT(found.solution.cost_final, 1e-9);
  EXPECT_NE(found.used, PoseGraphInitialization::kFile);
  EXPECT_EQ(found.refined_from_certified, found.used == PoseGraphInitialization::kCertified);
}

TYPED_TEST(CertificateOf, AutoKeepsAGoodFile) {
  const Walk<TypeParam> walk(40, 0.02);
  PackedGraph<TypeParam> graph = pack<TypeParam>(walk.graph);
  LocalSolver<TypeParam> first({}), second({});
  const double lowest = solve_from_initialization(graph, PoseGraphInitialization::kChordal,
                                                  RotationError::kLog, first)
                            .solution.cost_final;
  const InitializedSolution again =
      solve_from_initialization(graph, PoseGraphInitialization::kAuto, RotationError::kLog, second);
  EXPECT_EQ(again.used, PoseGraphInitialization::kFile);
  EXPECT_NEAR(again.solution.cost_final, lowest, 1e-7 * lowest);
}

TEST(PoseGraphInitialization, EveryStartEndsInTheSameMinimumOfAnEasyGraph) {
  const Walk<SE3> walk(40, 0.02);
  double lowest = 0;
  for (const PoseGraphInitialization start :
       {PoseGraphInitialization::kAuto, PoseGraphInitialization::kFile,
        PoseGraphInitialization::kOdometry, PoseGraphInitialization::kChordal,
        PoseGraphInitialization::kCertified}) {
    PackedGraph<SE3> graph = pack<SE3>(walk.graph);
    LocalSolver<SE3> solver({});
    const InitializedSolution found =
        solve_from_initialization(graph, start, RotationError::kLog, solver);
    if (lowest == 0) lowest = found.solution.cost_final;
    EXPECT_NEAR(found.solution.cost_final, lowest, 1e-6 * lowest) << to_string(start);
    if (start != PoseGraphInitialization::kAuto) {
      EXPECT_EQ(found.used, start);
    }
  }
}

}  // namespace certificate_test
}  // namespace placegraph
