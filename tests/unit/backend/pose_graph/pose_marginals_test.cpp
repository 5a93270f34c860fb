#include <gtest/gtest.h>
#include <placegraph/backend/pose_graph/pose_marginals.h>
#include <placegraph/backend/solver/normal_equations.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>

#include "tests/support/seed.h"

namespace placegraph {
namespace pose_marginals_test {

template <class Group>
Group random_pose(Random& random, double translation, double rotation) {
  typename Group::Tangent xi;
  for (int i = 0; i < Group::kDof; ++i)
    xi[i] = (i < (Group::kDof == 3 ? 2 : 3) ? translation : rotation) * random.normal();
  return Group::exp(xi);
}

/// A walk with loops, at noisy poses, information of full rank.
template <class Group>
PoseGraph walk(int count, Random& random) {
  PoseGraph graph;
  Group T;
  for (int i = 0; i < count; ++i) {
    graph.nodes.push_back({NodeId(10 + i), Pose(T)});
    T = T * random_pose<Group>(random, 1, 0.3);
  }
  const auto add = [&](int i, int j) {
    Eigen::MatrixXd A(Group::kDof, Group::kDof);
    for (Eigen::Index k = 0; k < A.size(); ++k) A.data()[k] = random.normal();
    RelativePoseConstraint edge;
    edge.from = graph.nodes[i].id;
    edge.to = graph.nodes[j].id;
    edge.T_from_to = std::get<Group>(graph.nodes[i].T_world_node).inverse() *
                     std::get<Group>(graph.nodes[j].T_world_node) *
                     random_pose<Group>(random, 0.02, 0.01);
    edge.information = A * A.transpose() + Eigen::MatrixXd::Identity(Group::kDof, Group::kDof);
    graph.constraints.emplace_back(edge);
  };
  for (int i = 0; i + 1 < count; ++i) add(i, i + 1);
  add(2, count - 2);
  add(count / 2, 1);
  add(0, count - 1);
  return graph;
}

/// The inverse of the normal equations, dense; zero for the held first node.
template <class Group>
Eigen::MatrixXd dense_covariance(const PoseGraph& graph) {
  const PackedGraph<Group> packed = pack<Group>(graph);
  NormalEquations<Group> equations(packed);
  equations.linearize(packed, RotationError::kLog);
  const int free = equations.block_count() * Group::kDof;
  Eigen::MatrixXd H(free, free);
  for (int i = 0; i < free; ++i) {
    Eigen::VectorXd column;
    equations.matrix().multiply(Eigen::VectorXd::Unit(free, i), column);
    H.col(i) = column;
  }
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(free + Group::kDof, free + Group::kDof);
  covariance.bottomRightCorner(free, free) = H.inverse();
  return covariance;
}

template <class Group>
class PoseMarginalsOf : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(PoseMarginalsOf, Groups);

TYPED_TEST(PoseMarginalsOf, AreBlocksOfTheDenseInverse) {
  using Group = TypeParam;
  constexpr int dof = Group::kDof;
  Random random = test::seeded_random(3);
  const PoseGraph graph = walk<Group>(14, random);
  const Eigen::MatrixXd dense = dense_covariance<Group>(graph);
  const PoseMarginals marginals(graph);
  ASSERT_TRUE(marginals.outcome());
  const double tolerance = 1e-9 * dense.norm();
  for (int i = 0; i < 14; ++i) {
    const auto expected = dense.block<dof, dof>(i * dof, i * dof);
    EXPECT_LT((marginals.covariance(NodeId(10 + i)) - expected).norm(), tolerance) << i;
  }
  const Eigen::MatrixXd joint = marginals.joint_covariance({NodeId(19), NodeId(10), NodeId(12)});
  EXPECT_LT((joint.block<dof, dof>(0, 2 * dof) - dense.block<dof, dof>(9 * dof, 2 * dof)).norm(),
            tolerance);
  EXPECT_EQ((joint.block<dof, dof>(dof, 0).norm()), 0);  // the held node
}

TYPED_TEST(PoseMarginalsOf, CarryRelativePosesThroughTheJacobianOfTheirError) {
  using Group = TypeParam;
  constexpr int dof = Group::kDof;
  Random random = test::seeded_random(4);
  const PoseGraph graph = walk<Group>(12, random);
  const Eigen::MatrixXd dense = dense_covariance<Group>(graph);
  const PoseMarginals marginals(graph);
  const std::vector<Information> by_node = marginals.covariances();
  ASSERT_EQ(by_node.size(), graph.nodes.size());
  for (std::size_t i = 0; i < by_node.size(); ++i)
    EXPECT_LT((by_node[i] - marginals.covariance(graph.nodes[i].id)).norm(), 1e-9 * dense.norm());
  const std::vector<Information> by_constraint = marginals.constraint_covariances();
  const auto expected = [&](int i, int j) {
    // d T_from_to by both poses is the Jacobian of the error of a constraint that fits exactly.
    const Group& a = std::get<Group>(graph.nodes[i].T_world_node);
    const Group& b = std::get<Group>(graph.nodes[j].T_world_node);
    const RelativePoseLinearization<Group> at((a.inverse() * b).inverse(), a, b,
                                              RotationError::kLog);
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(dof, dense.cols());
    J.middleCols(i * dof, dof) = at.J_from;
    J.middleCols(j * dof, dof) = at.J_to;
    return Eigen::MatrixXd(J * dense * J.transpose());
  };
  EXPECT_LT((marginals.relative_covariance(NodeId(13), NodeId(20)) - expected(3, 10)).norm(),
            1e-9 * dense.norm());
  EXPECT_LT((marginals.relative_covariance(NodeId(10), NodeId(15)) - expected(0, 5)).norm(),
            1e-9 * dense.norm());
  for (std::size_t k = 0; k < graph.constraints.size(); ++k) {
    const auto& edge = std::get<RelativePoseConstraint>(graph.constraints[k]);
    const Eigen::MatrixXd covariance =
        expected(static_cast<int>(edge.from.value()) - 10, static_cast<int>(edge.to.value()) - 10);
    EXPECT_LT((by_constraint[k] - covariance).norm(), 1e-9 * dense.norm()) << k;
  }
}

TEST(PoseMarginals, OfAGraphWithOpenDirectionsSaySoAndGiveNothing) {
  Random random = test::seeded_random(5);
  PoseGraph graph = walk<SE2>(6, random);
  for (Constraint& constraint : graph.constraints) {
    auto& edge = std::get<RelativePoseConstraint>(constraint);
    edge.information = Eigen::Vector3d(1, 1, 0).asDiagonal();
  }
  // A leaf whose rotation nothing fixes.
  graph.constraints.resize(5);
  const PoseMarginals marginals(graph);
  EXPECT_EQ(marginals.outcome().code, Outcome::Code::kDegenerate);
  EXPECT_THROW((void)marginals.covariance(NodeId(11)), Error);
  EXPECT_THROW((void)marginals.constraint_covariances(), Error);
}

TYPED_TEST(PoseMarginalsOf, RefuseTheRelativePoseOfNodesThatNothingConnects) {
  Random random = test::seeded_random(7);
  PoseGraph graph = walk<TypeParam>(7, random);
  const PoseGraph other = walk<TypeParam>(6, random);
  const auto moved = [](NodeId id) { return NodeId(id.value() + 100); };
  for (const PoseNode& node : other.nodes)
    graph.nodes.push_back({moved(node.id), node.T_world_node, node.fixed});
  for (const Constraint& constraint : other.constraints) {
    auto edge = std::get<RelativePoseConstraint>(constraint);
    edge.from = moved(edge.from);
    edge.to = moved(edge.to);
    graph.constraints.emplace_back(edge);
  }
  const PoseMarginals marginals(graph), alone(other);
  ASSERT_TRUE(marginals.outcome());
  for (int a = 0; a < 7; ++a)
    for (int b = 0; b < 6; ++b)
      for (const bool swapped : {false, true}) {
        const NodeId here(10 + a), there(110 + b);
        EXPECT_THROW((void)marginals.relative_covariance(swapped ? there : here,
                                                         swapped ? here : there),
                     ArgumentError);
      }
  EXPECT_EQ(marginals.relative_covariance(NodeId(110), NodeId(114)),
            alone.relative_covariance(NodeId(10), NodeId(14)));
}

TEST(PoseMarginals, RefuseUnknownNodes) {
  Random random = test::seeded_random(6);
  const PoseMarginals marginals(walk<SE3>(5, random));
  EXPECT_THROW((void)marginals.covariance(NodeId(4)), Error);
}

}  // namespace pose_marginals_test
}  // namespace placegraph
