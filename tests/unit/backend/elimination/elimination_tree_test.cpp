#include <gtest/gtest.h>
#include <placegraph/backend/elimination/elimination_tree.h>

#include <algorithm>

#include "tests/support/random_system.h"

namespace placegraph {
namespace elimination_tree_test {

/// A tree and the dense system that it must agree with.
class EliminationTreeTest : public ::testing::Test {
 protected:
  int add_variable() {
    const int v = system.add_variable();
    EXPECT_EQ(tree.add_variable(), v);
    tree.set_active(v, true);
    tree.set_gradient(v, system.gradients[v]);
    return v;
  }
  void add_term(int a, int b) {
    const RandomSystem::Term& term = system.add_term(a, b);
    numbers.push_back(tree.add_term(a, b));
    tree.set_information(numbers.back(), term.aa(), term.ab(), term.bb());
  }
  void remove_term(std::size_t i) {
    tree.remove_term(numbers[i]);
    numbers.erase(numbers.begin() + static_cast<std::ptrdiff_t>(i));
    system.terms.erase(system.terms.begin() + static_cast<std::ptrdiff_t>(i));
  }
  /// A chain of variables, the first of which has a term of its own; two longer edges.
  void build_chain(int length) {
    for (int v = 0; v < length; ++v) {
      add_variable();
      if (v == 0)
        add_term(0, -1);
      else
        v % 2 ? add_term(v - 1, v) : add_term(v, v - 1);
    }
    add_term(length / 4, length / 2);
    add_term(length - 2, 1);
  }
  std::size_t find_term(int a, int b) const {
    const auto found =
        std::find_if(system.terms.begin(), system.terms.end(),
                     [&](const RandomSystem::Term& term) { return term.a == a && term.b == b; });
    return static_cast<std::size_t>(found - system.terms.begin());
  }

  /// The decrease, the step and the covariance of all active variables against the dense ones.
  void expect_dense(const char* when) {
    SCOPED_TRACE(when);
    ASSERT_TRUE(tree.factorize());
    std::vector<int> active;
    for (int v = 0; v < static_cast<int>(system.gradients.size()); ++v)
      if (tree.active(v)) active.push_back(v);
    const Eigen::MatrixXd all = system.H(tree.damping());
    const Eigen::Index rows = static_cast<Eigen::Index>(3 * active.size());
    Eigen::MatrixXd H(rows, rows);
    Eigen::VectorXd g(rows);
    for (std::size_t i = 0; i < active.size(); ++i) {
      g.segment<3>(3 * i) = system.gradients[active[i]];
      for (std::size_t j = 0; j < active.size(); ++j)
        H.block<3, 3>(3 * i, 3 * j) = all.block<3, 3>(3 * active[i], 3 * active[j]);
    }
    const Eigen::MatrixXd inverse = H.inverse();
    EXPECT_NEAR(tree.model_decrease(), g.dot(inverse * g), 1e-9 * g.dot(inverse * g));
    std::vector<int> solved = tree.solve(0);
    std::sort(solved.begin(), solved.end());
    EXPECT_EQ(solved, active);
    const Eigen::VectorXd delta = -inverse * g;
    const Eigen::MatrixXd covariance = tree.covariance(active);
    EXPECT_LT((covariance - inverse).norm(), 1e-9 * inverse.norm());
    for (std::size_t i = 0; i < active.size(); ++i)
      EXPECT_LT((tree.delta(active[i]) - delta.segment<3>(3 * i)).norm(), 1e-9 * delta.norm())
          << active[i];
  }

  RandomSystem system{11};
  EliminationTree<3> tree;
  std::vector<int> numbers;  // of the terms in the tree
};

TEST_F(EliminationTreeTest, AgreesWithTheDenseSolution) {
  build_chain(20);
  expect_dense("built at once");
}

TEST_F(EliminationTreeTest, FollowsTermsThatAreAdded) {
  build_chain(12);
  expect_dense("before");
  add_term(0, 6);
  expect_dense("between variables of the chain");
  const int v = add_variable();
  add_term(v, 3);
  expect_dense("to a new variable");
  add_term(5, -1);
  expect_dense("over one variable");
}

TEST_F(EliminationTreeTest, FollowsTermsThatAreRemoved) {
  build_chain(12);
  add_term(0, 6);
  add_term(4, -1);
  expect_dense("before");
  remove_term(find_term(0, 6));
  expect_dense("a chord is gone");
  remove_term(find_term(4, -1));
  expect_dense("a term over one variable is gone");
  const std::vector<int> before = numbers;
  add_term(2, 9);
  EXPECT_TRUE(std::find(before.begin(), before.end(), numbers.back()) == before.end());
  expect_dense("another term in its place");
  add_term(3, 10);
  for (const auto& [a, b] : {std::pair(0, 1), std::pair(4, 3), std::pair(6, 5)}) {
    RandomSystem::Term& near = system.terms[find_term(a, b)];
    system.redraw(near);
    tree.set_information(numbers[find_term(a, b)], near.aa(), near.ab(), near.bb());
  }
  expect_dense("what the removed terms were over has changed");
}

TEST_F(EliminationTreeTest, FollowsInformationThatChanges) {
  build_chain(12);
  expect_dense("before");
  for (const std::size_t i : {std::size_t{0}, std::size_t{5}, system.terms.size() - 1}) {
    RandomSystem::Term& term = system.terms[i];
    system.redraw(term);
    tree.set_information(numbers[i], term.aa(), term.ab(), term.bb());
    expect_dense("changed");
  }
}

TEST_F(EliminationTreeTest, FollowsGradientsWithoutFactorizing) {
  build_chain(12);
  expect_dense("before");
  for (const int v : {0, 7, 11}) {
    system.gradients[v] = Eigen::Vector3d(1, -2, v);
    tree.set_gradient(v, system.gradients[v]);
    expect_dense("changed");
    EXPECT_EQ(tree.variables_refactored(), 0);
  }
}

TEST_F(EliminationTreeTest, VariablesThatAreNotActiveCountAsKnown) {
  build_chain(12);
  expect_dense("before");
  tree.set_active(5, false);
  EXPECT_FALSE(tree.active(5));
  expect_dense("one is held");
  tree.set_active(0, false);
  expect_dense("two are held");
  tree.set_active(5, true);
  expect_dense("one is free again");
}

TEST_F(EliminationTreeTest, DampingCountsAndEnds) {
  build_chain(12);
  tree.set_damping(0.2);
  EXPECT_EQ(tree.damping(), 0.2);
  expect_dense("damped");
  tree.set_damping(0);
  expect_dense("not damped");
}

TEST_F(EliminationTreeTest, ANewOrderGivesTheSameSolution) {
  build_chain(20);
  add_term(0, 19);
  expect_dense("before");
  add_term(2, 17);
  expect_dense("grown");
  tree.reorder();
  expect_dense("ordered anew");
  EXPECT_EQ(tree.variables_refactored(), 20);
  EXPECT_GT(tree.entries(), 0);
  EXPECT_EQ(tree.entries(), tree.entries_when_ordered());
}

TEST_F(EliminationTreeTest, AChangeAtOneEndOfAChainLeavesTheOtherAlone) {
  for (int v = 0; v < 60; ++v) {
    add_variable();
    v == 0 ? add_term(0, -1) : add_term(v - 1, v);
    ASSERT_TRUE(tree.factorize());
  }
  RandomSystem::Term& last = system.terms.back();
  system.redraw(last);
  tree.set_information(numbers.back(), last.aa(), last.ab(), last.bb());
  ASSERT_TRUE(tree.factorize());
  EXPECT_GT(tree.variables_refactored(), 0);
  EXPECT_LT(tree.variables_refactored(), 20);
  expect_dense("at the end");
}

TEST_F(EliminationTreeTest, OnlyWhatMovesIsSolvedFor) {
  for (int chain = 0; chain < 2; ++chain) {
    const int first = add_variable();
    add_term(first, -1);
    for (int i = 1; i < 4; ++i) {
      const int v = add_variable();
      add_term(v - 1, v);
    }
  }
  for (int v = 0; v < 4; ++v) tree.set_gradient(v, Eigen::Vector3d::Zero());
  ASSERT_TRUE(tree.factorize());
  EXPECT_GT(tree.model_decrease(), 1e-6);
  std::vector<int> solved = tree.solve(1e-12);
  std::sort(solved.begin(), solved.end());
  EXPECT_EQ(solved, (std::vector<int>{4, 5, 6, 7}));
  EXPECT_FALSE(tree.delta(4).isZero());
  EXPECT_TRUE(tree.delta(0).isZero());
  EXPECT_TRUE(tree.solve(1e12).empty());
  EXPECT_TRUE(tree.delta(4).isZero());
}

TEST_F(EliminationTreeTest, WhatMovesIsSolvedForBelowWhatStandsStill) {
  // All but the first variable are held so firmly that a step of the first one moves none of them.
  build_chain(20);
  for (int v = 1; v < 20; ++v) {
    const Eigen::Matrix3d firm = 1e9 * Eigen::Matrix3d::Identity();
    tree.set_information(tree.add_term(v, -1), firm, firm, firm);
    tree.set_gradient(v, Eigen::Vector3d::Zero());
  }
  ASSERT_TRUE(tree.factorize());
  const double decrease = tree.model_decrease();
  EXPECT_GT(decrease, 0);
  const std::vector<int> solved = tree.solve(1e-3 * decrease);
  EXPECT_EQ(std::count(solved.begin(), solved.end(), 0), 1);
  EXPECT_LT(solved.size(), 20u);
  const Eigen::Vector3d alone = -system.H().topLeftCorner<3, 3>().llt().solve(system.gradients[0]);
  EXPECT_LT((tree.delta(0) - alone).norm(), 1e-6 * alone.norm());
}

TEST_F(EliminationTreeTest, AMatrixThatIsNotPositiveDefiniteIsRefused) {
  add_variable();
  const int term = tree.add_term(0, -1);
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  tree.set_information(term, -one, one, one);
  EXPECT_FALSE(tree.factorize());
  tree.set_information(term, 2 * one, one, one);
  EXPECT_TRUE(tree.factorize());
  EXPECT_NEAR(tree.model_decrease(), system.gradients[0].squaredNorm() / 2, 1e-12);
}

}  // namespace elimination_tree_test
}  // namespace placegraph
