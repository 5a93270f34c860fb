#include <gtest/gtest.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>

#include <Eigen/Dense>
#include <algorithm>

#include "tests/support/scenes/pose_walk.h"

/// The two engines are independent of each other: each is the other's oracle.
namespace placegraph {
namespace engines_test {

using test::Walk;

constexpr std::uint64_t kSeeds = 6;

PoseGraphOptions tight(PoseGraphEngine engine, RotationError convention,
                       StepRule rule = StepRule::kDogleg) {
  PoseGraphOptions options;
  options.engine = engine;
  options.rotation_error = convention;
  options.step_rule = rule;
  options.relative_decrease = 1e-13;
  options.max_iterations = 1000;
  return options;
}

/// Information with correlations and very different scales.
template <class Group>
void make_anisotropic(PoseGraph& graph, std::uint64_t seed) {
  Random random(seed);
  for (Constraint& constraint : graph.constraints) {
    auto& edge = std::get<RelativePoseConstraint>(constraint);
    Eigen::MatrixXd A(Group::kDof, Group::kDof);
    for (Eigen::Index i = 0; i < A.size(); ++i) A.data()[i] = random.normal();
    A.row(0) *= 30;
    edge.information = A.transpose() * A + 0.1 * Eigen::MatrixXd::Identity(A.rows(), A.rows());
  }
}

template <class Group>
class Engines : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(Engines, Groups);

TYPED_TEST(Engines, AgreeOnTheMinimumUnderEveryConventionAndStepRule) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed)
    for (const RotationError convention : {RotationError::kLog, RotationError::kQuaternion}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed);
      Walk<TypeParam> walk(30, 0.05, seed);
      if (seed % 2) make_anisotropic<TypeParam>(walk.graph, seed);
      const PoseGraphReport ceres =
          optimize_pose_graph(walk.graph, tight(PoseGraphEngine::kCeres, convention));
      ASSERT_TRUE(ceres.outcome) << ceres.outcome.reason;
      for (const StepRule rule :
           {StepRule::kDogleg, StepRule::kGaussNewton, StepRule::kLevenbergMarquardt}) {
        const PoseGraphReport native =
            optimize_pose_graph(walk.graph, tight(PoseGraphEngine::kNative, convention, rule));
        ASSERT_TRUE(native.outcome) << native.outcome.reason;
        EXPECT_NEAR(native.chi2_final, ceres.chi2_final, 1e-9 * ceres.chi2_final)
            << "rule " << static_cast<int>(rule);
      }
    }
}

TYPED_TEST(Engines, AgreeWithRobustKernelsAndFalseLoops) {
  for (const auto kind : {RobustKernel::Kind::kHuber, RobustKernel::Kind::kCauchy})
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed);
      Walk<TypeParam> walk(30, 0.02, seed);
      for (Constraint& constraint : walk.graph.constraints)
        std::get<RelativePoseConstraint>(constraint).kernel = {kind, 1.5};
      auto lie = test::constraint<TypeParam>(13, 24, TypeParam());
      lie.kernel = {kind, 1.5};
      walk.graph.constraints.emplace_back(lie);
      const PoseGraphReport a =
          optimize_pose_graph(walk.graph, tight(PoseGraphEngine::kCeres, RotationError::kLog));
      const PoseGraphReport b =
          optimize_pose_graph(walk.graph, tight(PoseGraphEngine::kNative, RotationError::kLog));
      for (std::size_t i = 0; i < walk.truth.size(); ++i)
        EXPECT_LT(test::difference(walk.pose(a.graph, i), walk.pose(b.graph, i)), 1e-4) << i;
      EXPECT_NEAR(a.chi2_final, b.chi2_final, 1e-4 * a.chi2_final);
    }
}

TYPED_TEST(Engines, AgreeWhereConstraintsLeaveDirectionsOpen) {
  // Loops that know positions only, and a leaf whose rotation nothing measures.
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed)
    for (const PoseGraphEngine engine : {PoseGraphEngine::kNative, PoseGraphEngine::kCeres}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " engine " << static_cast<int>(engine));
      Walk<TypeParam> walk(20, 0.02, seed);
      const double before =
          optimize_pose_graph(walk.graph, tight(engine, RotationError::kQuaternion)).chi2_final;
      auto leaf = test::constraint<TypeParam>(12, 99, TypeParam());
      leaf.information.setZero();
      leaf.information(0, 0) = 4;
      leaf.information(1, 1) = 1;
      walk.graph.nodes.push_back({NodeId(99), walk.truth[2]});
      walk.graph.constraints.emplace_back(leaf);
      const PoseGraphReport report =
          optimize_pose_graph(walk.graph, tight(engine, RotationError::kQuaternion));
      EXPECT_TRUE(report.outcome) << report.outcome.reason;
      EXPECT_NEAR(report.chi2_final, before, 1e-7 * before);  // a leaf is free to fit
    }
}

TYPED_TEST(Engines, FromABadStartTheDoglegNeverEndsAboveWhereItBegan) {
  for (std::uint64_t seed = 1; seed <= 4 * kSeeds; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Walk<TypeParam> walk(25, 0.05, seed);
    Random random(seed);
    for (PoseNode& node : walk.graph.nodes)
      node.T_world_node =
          std::get<TypeParam>(node.T_world_node) * test::random_element<TypeParam>(random, 3, 1.5);
    for (const StepRule rule : {StepRule::kDogleg, StepRule::kLevenbergMarquardt}) {
      const PoseGraphReport report = optimize_pose_graph(
          walk.graph, tight(PoseGraphEngine::kNative, RotationError::kLog, rule));
      EXPECT_LT(report.chi2_final, report.chi2_initial);
      // A minimum: Ceres finds nothing better nearby.
      const PoseGraphReport polished =
          optimize_pose_graph(report.graph, tight(PoseGraphEngine::kCeres, RotationError::kLog));
      EXPECT_GT(polished.chi2_final, report.chi2_final * (1 - 1e-6));
    }
  }
}

}  // namespace engines_test
}  // namespace placegraph
