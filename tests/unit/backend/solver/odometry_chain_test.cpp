#include <gtest/gtest.h>
#include <placegraph/backend/solver/odometry_chain.h>

#include <Eigen/LU>
#include <algorithm>
#include <set>

#include "tests/support/packed_graphs.h"

namespace placegraph {
namespace odometry_chain_test {

/// A chain of odometry over all nodes in their order, its edges in any order.
template <class Group>
PackedGraph<Group> chain_of(int nodes, Random& random) {
  PackedGraph<Group> graph;
  graph.poses.resize(static_cast<std::size_t>(nodes));
  for (int i = 1; i < nodes; ++i)
    graph.edges.push_back({i - 1,
                           i,
                           i - 1,
                           true,
                           test::random_element<Group>(random, 1, 0.5),
                           test::random_information<typename Group::Jacobian>(random),
                           {}});
  test::shuffle(graph.edges, random);
  return graph;
}

template <class Group>
class OdometryChainOf : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(OdometryChainOf, Groups);

TYPED_TEST(OdometryChainOf, PoseIsTheProductOfTheMeasurements) {
  Random random(1);
  const PackedGraph<TypeParam> graph = chain_of<TypeParam>(9, random);
  const OdometryChain<TypeParam> chain(graph);
  EXPECT_EQ(chain.runs(), 1);
  TypeParam T_first_node;
  for (int node = 0; node < 9; ++node) {
    if (node > 0)
      for (const auto& edge : graph.edges)
        if (edge.to == node) T_first_node = T_first_node * edge.T_to_from.inverse();
    EXPECT_EQ(chain.position(node), node);
    EXPECT_LT((chain.pose(node).inverse() * T_first_node).log().norm(), 1e-12);
    EXPECT_EQ(chain.repeats_step(4, node), node == 3 || node == 5);
  }
}

TYPED_TEST(OdometryChainOf, CovarianceIsThatOfNoisePropagatedByDifferences) {
  using Jacobian = typename TypeParam::Jacobian;
  Random random(2);
  const PackedGraph<TypeParam> graph = chain_of<TypeParam>(7, random);
  const OdometryChain<TypeParam> chain(graph);
  constexpr int a = 2, b = 6;
  constexpr double kStep = 1e-4;
  Eigen::MatrixXd expected = Jacobian::Zero();
  for (std::size_t k = 0; k < graph.edges.size(); ++k) {
    if (graph.edges[k].from < a || graph.edges[k].to > b) continue;
    Eigen::MatrixXd J(TypeParam::kDof, TypeParam::kDof);
    for (int i = 0; i < TypeParam::kDof; ++i) {
      typename TypeParam::Tangent moved[2];
      for (const int side : {0, 1}) {
        PackedGraph<TypeParam> other = graph;
        auto& T_to_from = other.edges[k].T_to_from;
        const typename TypeParam::Tangent xi = TypeParam::Tangent::Unit(i) * kStep;
        // T_from_to exp(xi), as the information is in the right tangent of the measurement.
        T_to_from = TypeParam::exp(side ? -xi : xi) * T_to_from;
        moved[side] = (OdometryChain<TypeParam>(other).pose(b) * chain.pose(b).inverse()).log();
      }
      J.col(i) = (moved[1] - moved[0]) / (2 * kStep);
    }
    const Eigen::MatrixXd information = graph.edges[k].information;
    expected += J * information.inverse() * J.transpose();
  }
  // The differences are good to the square of their step.
  EXPECT_LT((chain.covariance(a, b) - expected).norm(), 1e-6 * expected.norm());
  EXPECT_EQ(chain.covariance(a, b), chain.covariance(b, a));
  const Jacobian parts = chain.covariance(a, 4) + chain.covariance(4, b);
  EXPECT_LT((chain.covariance(a, b) - parts).norm(), 1e-12 * parts.norm());
}

TYPED_TEST(OdometryChainOf, UsesTheMostInformativeOfSeveralEdgesInAnyOrder) {
  Random random(3);
  PackedGraph<TypeParam> graph = chain_of<TypeParam>(8, random);
  const OdometryChain<TypeParam> best(graph);
  for (std::size_t i = 0; i < 7; ++i)
    for (const double share : {0.5, 0.9}) {
      auto worse = graph.edges[i];
      worse.T_to_from = test::random_element<TypeParam>(random, 1, 0.5);
      worse.information *= share;
      graph.edges.push_back(worse);
    }
  for (int trial = 0; trial < 5; ++trial) {
    test::shuffle(graph.edges, random);
    const OdometryChain<TypeParam> chain(graph);
    EXPECT_EQ(chain.runs(), 1);
    for (int node = 0; node < 8; ++node)
      EXPECT_EQ(chain.pose(node).matrix(), best.pose(node).matrix());
    EXPECT_EQ(chain.covariance(0, 7), best.covariance(0, 7));
  }
}

PackedGraph<SE2> odometry(int nodes, const std::vector<std::pair<int, int>>& ends) {
  PackedGraph<SE2> graph;
  graph.poses.resize(static_cast<std::size_t>(nodes));
  for (const auto& [from, to] : ends)
    graph.edges.push_back(
        {from, to, 0, true, SE2(-1, 0, 0), SE2::Jacobian(SE2::Jacobian::Identity()), {}});
  return graph;
}

TEST(OdometryChainRuns, AreAsManyAsThereArePiecesWithoutOdometryBetweenThem) {
  PackedGraph<SE2> graph = odometry(7, {{5, 2}, {2, 6}, {0, 4}, {4, 3}});
  graph.edges[3].odometry = false;
  const OdometryChain<SE2> chain(graph);
  EXPECT_EQ(chain.runs(), 4);  // 5 2 6, 0 4, 1 and 3
  EXPECT_EQ(chain.run(5), chain.run(2));
  EXPECT_EQ(chain.run(5), chain.run(6));
  EXPECT_EQ(chain.run(0), chain.run(4));
  EXPECT_EQ((std::set<int>{chain.run(0), chain.run(1), chain.run(3), chain.run(5)}),
            (std::set<int>{0, 1, 2, 3}));
  EXPECT_EQ(chain.position(6), 2);
  EXPECT_FALSE(chain.repeats_step(4, 3));
  EXPECT_EQ(OdometryChain<SE2>(PackedGraph<SE2>()).runs(), 0);
}

TEST(OdometryChainRuns, OfARingEndsBeforeTheStart) {
  const OdometryChain<SE2> chain(odometry(5, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}}));
  EXPECT_EQ(chain.runs(), 1);
  std::set<int> positions;
  for (int node = 0; node < 5; ++node) positions.insert(chain.position(node));
  EXPECT_EQ(positions, (std::set<int>{0, 1, 2, 3, 4}));
  EXPECT_NEAR(chain.pose(4).translation().x(), 4, 1e-12);
  EXPECT_FALSE(chain.repeats_step(4, 0));
}

TEST(OdometryChainRuns, HaveEveryNodeOnceAndStepAlongOdometry) {
  Random random(4);
  for (int trial = 0; trial < 100; ++trial) {
    const int n = 2 + random.index(10);
    std::vector<std::pair<int, int>> ends;
    for (int k = random.index(2 * n); k > 0; --k) {
      const int from = random.index(n);
      ends.emplace_back(from, (from + 1 + random.index(n - 1)) % n);
    }
    const OdometryChain<SE2> chain(odometry(n, ends));
    std::set<std::pair<int, int>> places;
    for (int node = 0; node < n; ++node) {
      EXPECT_GE(chain.run(node), 0);
      EXPECT_LT(chain.run(node), chain.runs());
      places.emplace(chain.run(node), chain.position(node));
    }
    EXPECT_EQ(places.size(), static_cast<std::size_t>(n)) << "trial " << trial;
    for (int b = 0; b < n; ++b) {
      if (chain.position(b) == 0) continue;
      EXPECT_TRUE(std::any_of(ends.begin(), ends.end(),
                              [&](const auto& edge) {
                                return edge.second == b && chain.run(edge.first) == chain.run(b) &&
                                       chain.position(edge.first) == chain.position(b) - 1;
                              }))
          << "trial " << trial << " node " << b;
    }
  }
}

TEST(CovarianceOf, IsTheInverseWithALeastInformationInEveryDirection) {
  Random random(5);
  const Matrix6d information = test::random_information<Matrix6d>(random);
  EXPECT_LT((covariance_of(information) * information - Matrix6d::Identity()).norm(), 1e-10);
  const Eigen::Matrix3d flat = Eigen::Vector3d(4, 0, 1e-12).asDiagonal();
  const Eigen::Matrix3d expected = Eigen::Vector3d(0.25, 1 / 4e-9, 1 / 4e-9).asDiagonal();
  EXPECT_LT((covariance_of(flat) - expected).norm(), 1e-9 * expected.norm());
}

}  // namespace odometry_chain_test
}  // namespace placegraph
