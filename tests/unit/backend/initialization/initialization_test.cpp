#include <gtest/gtest.h>
#include <placegraph/backend/initialization/initialization.h>
#include <placegraph/backend/initialization/isotropic_problem.h>
#include <placegraph/backend/solver/local_solver.h>

#include "tests/support/scenes/pose_walk.h"

namespace placegraph {
namespace initialization_test {

using test::Walk;

/// Poses of a start say nothing: all at one place, turned about.
template <class Group>
PackedGraph<Group> without_poses(const PoseGraph& graph) {
  PackedGraph<Group> packed = pack<Group>(graph);
  Random random(3);
  for (std::size_t i = 0; i < packed.poses.size(); ++i)
    if (!packed.components.held[i]) packed.poses[i] = test::random_element<Group>(random, 5, 2);
  return packed;
}

template <class Group>
void expect_truth(const PackedGraph<Group>& graph, const std::vector<Group>& truth, double error) {
  for (std::size_t i = 0; i < truth.size(); ++i)
    EXPECT_LT(test::difference(graph.poses[i], truth[i]), error) << "node " << i;
}

template <class Group>
class InitializationOf : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(InitializationOf, Groups);

TYPED_TEST(InitializationOf, BothStartsAreExactWhereTheMeasurementsAgree) {
  const Walk<TypeParam> walk(40, 0);
  PackedGraph<TypeParam> graph = without_poses<TypeParam>(walk.graph);
  spanning_tree_initialization(graph);
  expect_truth(graph, walk.truth, 1e-10);
  graph = without_poses<TypeParam>(walk.graph);
  chordal_initialization(graph);
  expect_truth(graph, walk.truth, 1e-8);
}

TYPED_TEST(InitializationOf, ChordalStartLiesNearTheMinimumOfANoisyGraph) {
  const Walk<TypeParam> walk(40, 0.03);
  PackedGraph<TypeParam> graph = without_poses<TypeParam>(walk.graph);
  const double before = robust_cost(graph, RotationError::kLog);
  chordal_initialization(graph);
  const double chordal = robust_cost(graph, RotationError::kLog);
  EXPECT_LT(chordal, 1e-3 * before);
  LocalSolver<TypeParam> solver({});
  EXPECT_TRUE(solver.solve(graph).outcome);
  EXPECT_LT(chordal, 3 * robust_cost(graph, RotationError::kLog));
}

TYPED_TEST(InitializationOf, HeldNodesStayAndPlaceTheRest) {
  Walk<TypeParam> walk(20, 0);
  walk.graph.nodes[0].T_world_node = walk.truth[0];
  for (const int i : {4, 13}) {
    walk.graph.nodes[i].fixed = true;
    walk.graph.nodes[i].T_world_node = walk.truth[i];
  }
  for (const bool chordal : {false, true}) {
    PackedGraph<TypeParam> graph = without_poses<TypeParam>(walk.graph);
    EXPECT_FALSE(graph.components.held[0]);
    if (chordal)
      chordal_initialization(graph);
    else
      spanning_tree_initialization(graph);
    EXPECT_EQ(graph.poses[13].matrix(), walk.truth[13].matrix());
    expect_truth(graph, walk.truth, 1e-8);
  }
}

TYPED_TEST(InitializationOf, MeasuredPositionsPlaceWhatNothingHolds) {
  Walk<TypeParam> walk(20, 0);
  const Eigen::Vector3d lever_arm(0.3, -0.2, 0.5);
  constexpr int dim = kSpaceDim<TypeParam>;
  for (std::size_t i = 0; i < walk.truth.size(); i += 3) {
    PositionConstraint position;
    position.node = NodeId(10 + static_cast<std::int64_t>(i));
    position.lever_arm = lever_arm;
    position.position_world.template head<dim>() =
        walk.truth[i] * typename TypeParam::Point(lever_arm.head<dim>());
    walk.graph.constraints.emplace_back(position);
  }
  for (const bool chordal : {false, true}) {
    PackedGraph<TypeParam> graph = without_poses<TypeParam>(walk.graph);
    EXPECT_FALSE(graph.components.held[0]);
    if (chordal)
      chordal_initialization(graph);
    else
      spanning_tree_initialization(graph);
    // Of the scale only the lever arms tell, besides the positions' spread: it is not exact there.
    EXPECT_LT(test::difference(graph.poses[7], walk.truth[7]), TypeParam::kDof == 7 ? 1 : 1e-7);
  }
}

TYPED_TEST(InitializationOf, EdgesWithoutWeightAreLeftOut) {
  Walk<TypeParam> walk(20, 0);
  walk.graph.constraints.emplace_back(test::constraint<TypeParam>(12, 25, TypeParam()));  // false
  PackedGraph<TypeParam> graph = without_poses<TypeParam>(walk.graph);
  graph.edges.back().weight = 0;
  chordal_initialization(graph);
  expect_truth(graph, walk.truth, 1e-8);
}

TYPED_TEST(InitializationOf, InformationMayLeaveDirectionsOpen) {
  Walk<TypeParam> walk(20, 0);
  for (std::size_t i = 0; i < walk.graph.constraints.size(); i += 2) {
    auto& information = std::get<RelativePoseConstraint>(walk.graph.constraints[i]).information;
    information(0, 0) = 0;
    information(kSpaceDim<TypeParam>, kSpaceDim<TypeParam>) = 0;
  }
  PackedGraph<TypeParam> graph = without_poses<TypeParam>(walk.graph);
  chordal_initialization(graph);
  expect_truth(graph, walk.truth, 1e-6);
}

TYPED_TEST(InitializationOf, TheScaleOfTheInformationDoesNotMatter) {
  const Walk<TypeParam> walk(20, 0.05);
  PackedGraph<TypeParam> graph = pack<TypeParam>(walk.graph), scaled = graph;
  for (auto& edge : scaled.edges) edge.information *= 1e7;
  chordal_initialization(graph);
  chordal_initialization(scaled);
  expect_truth(scaled, graph.poses, 1e-9);
}

TEST(IsotropicProblem, HarmonicMeanOfEigenvaluesIsComputedByHand) {
  // 2 / (1/1 + 1/4) = 1.6; the floor lifts both eigenvalues by 2.5e-3.
  EXPECT_NEAR(harmonic_mean<2>(Eigen::Vector2d(1, 4).asDiagonal()), 1.6, 4e-3);
  EXPECT_NEAR(harmonic_mean<3>(Eigen::Vector3d(1, 2, 4).asDiagonal()), 3 / 1.75, 5e-3);
  // 3 / (1000/2 + 2/3) with the zero lifted to 2e-3.
  EXPECT_NEAR(harmonic_mean<3>(Eigen::Vector3d(0, 3, 3).asDiagonal()), 3 / (500 + 2.0 / 3), 1e-5);
  EXPECT_EQ(harmonic_mean<3>(Eigen::Matrix3d::Zero()), 0);
}

TEST(IsotropicProblem, IsTheCostOfIsotropicInformationInTheConventionOfG2o) {
  const Walk<SE3> walk(20, 0.3);
  const PackedGraph<SE3> graph = pack<SE3>(walk.graph);
  const double cost = robust_cost(graph, RotationError::kQuaternion);
  const auto problem = isotropic_problem(graph, RotationError::kQuaternion);
  EXPECT_NEAR(isotropic_cost(problem, graph.poses), cost, 1.1e-3 * cost);  // the eigenvalue floor
}

TEST(IsotropicProblem, NearestRotationProjectsAndSurvivesSingularMatrices) {
  const SO3 R = SO3::exp({0.3, -2, 1});
  Eigen::Matrix3d stretch = Eigen::Vector3d(0.01, 0.5, 2).asDiagonal();
  EXPECT_LT((nearest_rotation(Eigen::Matrix3d(R.matrix() * stretch)).inverse() * R).log().norm(),
            1e-9);
  stretch(0, 0) = 0;  // a plane is left, which fixes the rotation all the same
  EXPECT_LT((nearest_rotation(Eigen::Matrix3d(R.matrix() * stretch)).inverse() * R).log().norm(),
            1e-9);
  EXPECT_EQ(nearest_rotation(Eigen::Matrix3d(Eigen::Matrix3d::Zero())).matrix(),
            Eigen::Matrix3d::Identity());
  EXPECT_NEAR(nearest_rotation(Eigen::Matrix2d(3 * SO2(0.7).matrix())).angle(), 0.7, 1e-12);
}

}  // namespace initialization_test
}  // namespace placegraph
