#include <gtest/gtest.h>
#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/backend/robust/loop_leverage.h>
#include <placegraph/backend/robust/loop_pairs.h>
#include <placegraph/backend/robust/parallel_odometry.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <set>

#include "tests/support/packed_graphs.h"
#include "tests/support/scenes/looped_walk.h"

namespace placegraph {
namespace loop_pairs_test {

Eigen::MatrixXd inverse(const Eigen::MatrixXd& A) {
  return A.ldlt().solve(Eigen::MatrixXd::Identity(A.rows(), A.cols()));
}

Eigen::MatrixXd congruent(const Eigen::MatrixXd& J, const Eigen::MatrixXd& A) {
  return J.transpose() * A * J;
}

double log_determinant(const Eigen::MatrixXd& A) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvalues().array().log().sum();
}

template <class Group>
class LoopPairsOf : public testing::Test {
 protected:
  PackedGraph<Group> graph = pack<Group>(
      test::LoopedWalk<Group>({.nodes = 60, .lap = 15, .noise = 0.05, .false_loops = 15}).graph);
};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(LoopPairsOf, Groups);

TYPED_TEST(LoopPairsOf, CloseUpToTheirMisclosure) {
  const OdometryChain<TypeParam> chain(this->graph);
  const auto loops = loops_on_chain(this->graph, chain);
  for (const auto& a : loops)
    for (const auto& b : loops) {
      const double chi2 = ring_misclosure(a, b, chain).chi2;
      EXPECT_TRUE(ring_closes(a, b, chain, chi2 * (1 + 1e-6) + 1e-9));
      if (chi2 > 1e-6) {
        EXPECT_FALSE(ring_closes(a, b, chain, chi2 * (1 - 1e-6)));
      }
    }
}

TYPED_TEST(LoopPairsOf, DependNeitherOnTheOrderNorOnTheDirectionOfTheLoops) {
  PackedGraph<TypeParam> other = this->graph;
  Random random(1);
  test::shuffle(other.edges, random);
  for (auto& edge : other.edges) {
    if (edge.odometry || random.uniform() < 0.5) continue;
    // The information of the inverse motion is that of the other end's frame.
    edge.information = congruent(edge.T_to_from.adjoint(), edge.information);
    edge.T_to_from = edge.T_to_from.inverse();
    std::swap(edge.from, edge.to);
  }
  const OdometryChain<TypeParam> chain(this->graph);
  const auto loops = loops_on_chain(this->graph, chain), same = loops_on_chain(other, chain);
  ASSERT_EQ(loops.size(), same.size());
  for (std::size_t i = 0; i < loops.size(); ++i) {
    EXPECT_EQ(loops[i].from, same[i].from);
    EXPECT_EQ(loops[i].to, same[i].to);
    EXPECT_LT(chain.position(loops[i].from), chain.position(loops[i].to));
    const double size = loops[i].covariance.norm();
    EXPECT_LT((loops[i].W.inverse() * same[i].W).log().norm(), 1e-9);
    EXPECT_LT((loops[i].covariance - same[i].covariance).norm(), 1e-9 * size);
  }
}

TYPED_TEST(LoopPairsOf, AreTheNearestOnesOfAllWithinReach) {
  const OdometryChain<TypeParam> chain(this->graph);
  const auto loops = loops_on_chain(this->graph, chain);
  const int n = static_cast<int>(loops.size());
  for (const int reach : {1, 4, 100})
    for (const int neighbours : {1, 3, 50}) {
      std::set<std::pair<int, int>> expected;
      for (int i = 0; i < n; ++i) {
        std::vector<std::pair<int, int>> near;
        for (int k = 0; k < n; ++k) {
          const int at_from = std::abs(loops[i].from - loops[k].from);
          const int at_to = std::abs(loops[i].to - loops[k].to);
          if (k != i && at_from <= reach && at_to <= reach) near.emplace_back(at_from + at_to, k);
        }
        std::sort(near.begin(), near.end());
        for (int k = 0; k < std::min(neighbours, static_cast<int>(near.size())); ++k)
          expected.insert(std::minmax(i, near[k].second));
      }
      std::vector<std::pair<int, int>> found;
      for (const LoopPair& pair : neighbouring_pairs(loops, chain, reach, neighbours)) {
        found.emplace_back(pair.a, pair.b);
        const RingMisclosure ring = ring_misclosure(loops[pair.a], loops[pair.b], chain);
        EXPECT_EQ(pair.ring.chi2, ring.chi2);
      }
      EXPECT_EQ(found, (std::vector<std::pair<int, int>>(expected.begin(), expected.end())))
          << "reach " << reach << " neighbours " << neighbours;
    }
}

TYPED_TEST(LoopPairsOf, OfExactLoopsHaveNoMisclosureAndTheDeterminantOfTheirNoise) {
  this->graph = pack<TypeParam>(
      test::LoopedWalk<TypeParam>({.nodes = 40, .lap = 10, .noise = 0, .claimed = 0.1}).graph);
  const OdometryChain<TypeParam> chain(this->graph);
  const auto loops = loops_on_chain(this->graph, chain);
  for (const auto& loop : loops) {
    const RingMisclosure drift = drift_misclosure(loop, chain);
    EXPECT_LT(drift.chi2, 1e-12);
    const Eigen::MatrixXd covariance = loop.covariance + chain.covariance(loop.from, loop.to);
    EXPECT_NEAR(drift.log_determinant, log_determinant(covariance), 1e-8);
    // A loop and its copy close a ring of two measurements.
    const RingMisclosure twice = ring_misclosure(loop, loop, chain);
    const Eigen::MatrixXd of_both = 2 * loop.covariance;
    EXPECT_NEAR(twice.log_determinant, log_determinant(of_both), 1e-8);
  }
  EXPECT_LT(ring_misclosure(loops.front(), loops.back(), chain).chi2, 1e-12);
}

TYPED_TEST(LoopPairsOf, CostOfAddingIsThatOfTheLinearizedGraph) {
  constexpr int dof = TypeParam::kDof;
  this->graph = test::packed_walk<TypeParam>(8, 0.02, 2);
  (void)LocalSolver<TypeParam>({}).solve(this->graph);
  std::vector<int> loops;
  for (std::size_t i = 0; i < this->graph.edges.size(); ++i)
    if (!this->graph.edges[i].odometry) loops.push_back(static_cast<int>(i));
  for (const int loop : loops) this->graph.edges[loop].weight = 0;
  const auto rows = static_cast<Eigen::Index>(this->graph.poses.size()) * dof;
  const auto jacobian_of = [&](const auto& edge, typename TypeParam::Tangent& e) {
    const RelativePoseLinearization<TypeParam> at(edge.T_to_from, this->graph.poses[edge.from],
                                                  this->graph.poses[edge.to], RotationError::kLog);
    e = at.e;
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(dof, rows);
    J.middleCols<dof>(edge.from * dof) = at.J_from;
    J.middleCols<dof>(edge.to * dof) = at.J_to;
    return J.rightCols(rows - dof).eval();  // the first node is held
  };
  typename TypeParam::Tangent e;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(rows - dof, rows - dof);
  for (const auto& edge : this->graph.edges) {
    H += edge.weight * congruent(jacobian_of(edge, e), edge.information);
  }
  const Eigen::MatrixXd covariance = inverse(H);
  const auto cost = cost_of_adding(this->graph, loops, RotationError::kLog, 1e9);
  ASSERT_EQ(cost.size(), loops.size());
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const auto& edge = this->graph.edges[loops[i]];
    const Eigen::MatrixXd J = jacobian_of(edge, e);
    const Eigen::MatrixXd sum = inverse(edge.information) + congruent(J.transpose(), covariance);
    const double expected = Eigen::VectorXd(e).dot(inverse(sum) * e);
    EXPECT_NEAR(cost[i], expected, 1e-6 * expected);
    EXPECT_LT(cost[i], e.dot(edge.information * e)) << "the graph gives way";
  }
  EXPECT_TRUE(cost_of_adding(this->graph, {}, RotationError::kLog, 1).empty());
  this->graph.edges[0].weight = 0;  // a part of the graph that nothing ties down
  EXPECT_TRUE(cost_of_adding(this->graph, loops, RotationError::kLog, 1).empty());
}

TYPED_TEST(LoopPairsOf, ParallelOdometryIsThatWhichAgreesWithTheLoops) {
  const test::LoopedWalk<TypeParam> walk({.nodes = 60, .lap = 15, .claimed = 0.02, .seed = 5});
  this->graph = pack<TypeParam>(walk.graph);
  std::set<int> wrong;  // constraints
  Random random(6);
  for (const int step : {20, 21, 33}) {
    auto slip = this->graph.edges[step];
    slip.constraint = 1000 + step;
    slip.T_to_from = test::random_element<TypeParam>(random, 1, 0.3) * slip.T_to_from;
    slip.information *= step == 21 ? 0.5 : 2;  // of one, not the others, the claim is right
    wrong.insert(slip.constraint);
    this->graph.edges.push_back(slip);
  }
  this->graph.poses = walk.truth;
  for (int trial = 0; trial < 3; ++trial) {
    PackedGraph<TypeParam> apart = this->graph;
    test::shuffle(apart.edges, random);
    EXPECT_EQ(set_parallel_odometry_apart(apart, {}), 3);
    int odometry = 0;
    for (const auto& edge : apart.edges) {
      odometry += edge.odometry;
      EXPECT_FALSE(edge.odometry && wrong.count(edge.constraint)) << edge.constraint;
    }
    EXPECT_EQ(odometry, 59);
    EXPECT_EQ(set_parallel_odometry_apart(apart, {}), 0) << "nothing is parallel any more";
  }
}

}  // namespace loop_pairs_test
}  // namespace placegraph
