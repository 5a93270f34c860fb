#include <gtest/gtest.h>
#include <placegraph/backend/elimination/front_assembly.h>
#include <placegraph/backend/elimination/front_covariance.h>
#include <placegraph/backend/elimination/front_kernels.h>

#include "tests/support/random_system.h"

namespace placegraph {
namespace front_assembly_test {

constexpr double kRounding = 1e-9;

/// Five variables in three fronts, variable v being the v-th that is eliminated: the root
/// eliminates 3 and 4, a child 0 and 1, another 2. The first child names its separator in another
/// order than the root.
class FrontAssembly : public ::testing::Test {
 protected:
  FrontAssembly() {
    for (int v = 0; v < 5; ++v) {
      system.add_variable();
      system.add_term(v, -1);
    }
    // Both directions: earlier to later variables, and back.
    for (const auto& [a, b] : std::vector<std::pair<int, int>>{
             {0, 1}, {3, 0}, {0, 4}, {1, 4}, {1, 3}, {3, 2}, {3, 4}, {4, 3}})
      system.add_term(a, b);
    forest.variables.resize(5);
    for (int v = 0; v < 5; ++v) {
      auto& variable = forest.variables[v];
      variable.active = variable.diagonal_stale = true;
      variable.order = v;
      variable.gradient = system.gradients[v];
    }
    for (const RandomSystem::Term& term : system.terms) {
      for (const int v : {term.a, term.b})
        if (v >= 0) forest.variables[v].terms.push_back(static_cast<int>(forest.terms.size()));
      forest.terms.push_back({term.a, term.b, term.aa(), term.ab(), term.bb(), false});
    }
    forest.fronts.resize(3);
    forest.fronts[0].frontal = {0, 1};
    forest.fronts[0].separator = {4, 3};
    forest.fronts[1].frontal = {2};
    forest.fronts[1].separator = {3};
    forest.fronts[2].frontal = {3, 4};
    forest.fronts[2].children = {0, 1};
    forest.fronts[0].parent = forest.fronts[1].parent = 2;
    for (int f = 0; f < 3; ++f)
      for (const int v : forest.fronts[f].frontal) forest.variables[v].front = f;
    forest.roots = {2};
  }

  void factorize(double damping) {
    for (auto& front : forest.fronts) {
      assemble(forest, front, damping, pool);
      ASSERT_TRUE(FrontKernels<3>::factorize(front.matrix.data(), front.blocks() * 3,
                                             static_cast<int>(front.frontal.size()) * 3));
    }
  }

  static std::vector<int> members(const FrontForest<3>::Front& front) {
    std::vector<int> all = front.frontal;
    all.insert(all.end(), front.separator.begin(), front.separator.end());
    return all;
  }

  /// All fronts' columns of L against those of the dense matrix.
  void expect_factor(double damping) const {
    const Eigen::MatrixXd L = system.H(damping).llt().matrixL();
    for (const auto& front : forest.fronts) {
      const Eigen::Index rows = front.blocks() * 3;
      const Eigen::Map<const Eigen::MatrixXd> matrix(front.matrix.data(), rows, rows);
      const std::vector<int> all = members(front);
      for (std::size_t column = 0; column < front.frontal.size(); ++column)
        for (std::size_t row = column; row < all.size(); ++row) {
          Eigen::Matrix3d block = matrix.block<3, 3>(3 * row, 3 * column);
          if (row == column) block = block.triangularView<Eigen::Lower>();
          EXPECT_TRUE(block.isApprox(L.block<3, 3>(3 * all[row], 3 * all[column]), kRounding))
              << all[row] << ' ' << all[column];
        }
    }
  }

  RandomSystem system{7};
  FrontForest<3> forest;
  MatrixPool pool;
};

TEST_F(FrontAssembly, FrontsHoldTheColumnsOfTheDenseFactor) {
  factorize(0);
  expect_factor(0);
}

TEST_F(FrontAssembly, DampingAddsAShareOfTheMeanOfEachVariablesOwnDiagonal) {
  factorize(0.3);
  expect_factor(0.3);
}

TEST_F(FrontAssembly, WhatAMatrixHeldBeforeDoesNotCount) {
  factorize(0.5);
  factorize(0);
  expect_factor(0);
  for (const auto& variable : forest.variables) EXPECT_EQ(variable.local, -1);
}

TEST_F(FrontAssembly, ZeroTermsAddNothing) {
  forest.terms[5].zero = true;  // the pair of 0 and 1
  system.terms[5].H.topRightCorner<3, 3>().setZero();
  system.terms[5].H.bottomLeftCorner<3, 3>().setZero();
  factorize(0);
  expect_factor(0);
}

TEST_F(FrontAssembly, ForwardSubstitutionSolvesWithTheFactor) {
  factorize(0);
  for (int pass = 0; pass < 2; ++pass)
    for (auto& front : forest.fronts) substitute_forward(forest, front);
  const Eigen::VectorXd y = system.H().llt().matrixL().solve(-system.g());
  const auto part = [&](int front, int variable) {
    return (Eigen::Map<const Eigen::VectorXd>(forest.fronts[front].rhs.data(), 6)
                .segment<3>(variable) -
            y.segment<3>(3 * forest.fronts[front].frontal[variable / 3]))
        .norm();
  };
  EXPECT_LT(part(0, 0), kRounding);
  EXPECT_LT(part(0, 3), kRounding);
  EXPECT_LT(part(1, 0), kRounding);
  EXPECT_LT(part(2, 0), kRounding);
  EXPECT_LT(part(2, 3), kRounding);
  EXPECT_NEAR(forest.fronts[0].decrease, y.head<6>().squaredNorm(), kRounding);
  EXPECT_NEAR(forest.fronts[2].decrease, y.squaredNorm(), kRounding);
  EXPECT_NEAR(forest.fronts[2].decrease, system.g().dot(system.H().llt().solve(system.g())),
              kRounding);
}

TEST_F(FrontAssembly, CovarianceHasTheBlocksOfTheDenseInverseInTheOrderAskedFor) {
  factorize(0);
  const Eigen::MatrixXd inverse = system.H().inverse();
  for (const std::vector<int>& asked :
       std::vector<std::vector<int>>{{4, 0, 2}, {1}, {2, 3}, {0, 1, 2, 3, 4}}) {
    const Eigen::MatrixXd blocks = covariance(forest, asked);
    ASSERT_EQ(blocks.rows(), static_cast<Eigen::Index>(3 * asked.size()));
    ASSERT_EQ(blocks.cols(), blocks.rows());
    for (std::size_t i = 0; i < asked.size(); ++i)
      for (std::size_t j = 0; j < asked.size(); ++j)
        EXPECT_LT(
            (blocks.block<3, 3>(3 * i, 3 * j) - inverse.block<3, 3>(3 * asked[i], 3 * asked[j]))
                .norm(),
            kRounding)
            << asked[i] << ' ' << asked[j];
  }
}

/// Small fronts, and those that BLAS does.
class FrontKernelsTest : public ::testing::TestWithParam<int> {
 protected:
  Eigen::MatrixXd random_matrix() const {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    const Eigen::MatrixXd J = Eigen::MatrixXd::NullaryExpr(
        rows, rows, [&](Eigen::Index, Eigen::Index) { return normal(random); });
    return J * J.transpose() + rows * Eigen::MatrixXd::Identity(rows, rows);
  }
  const int rows = GetParam(), frontal = rows / 6 * 3, below = rows - frontal;
};
INSTANTIATE_TEST_SUITE_P(Sizes, FrontKernelsTest, ::testing::Values(12, 33, 63, 66, 96));

TEST_P(FrontKernelsTest, FactorizesAndLeavesTheSchurComplement) {
  const Eigen::MatrixXd A = random_matrix();
  Eigen::MatrixXd matrix = A;
  ASSERT_TRUE(FrontKernels<3>::factorize(matrix.data(), rows, frontal));
  const Eigen::MatrixXd L11 = A.topLeftCorner(frontal, frontal).llt().matrixL();
  const Eigen::MatrixXd schur =
      A.bottomRightCorner(below, below) - A.bottomLeftCorner(below, frontal) *
                                              A.topLeftCorner(frontal, frontal).inverse() *
                                              A.topRightCorner(frontal, below);
  const Eigen::MatrixXd lower = matrix.triangularView<Eigen::Lower>();
  EXPECT_LT((lower.topLeftCorner(frontal, frontal) - L11).norm(), 1e-9 * rows);
  EXPECT_LT((lower.bottomLeftCorner(below, frontal) * L11.transpose() -
             A.bottomLeftCorner(below, frontal))
                .norm(),
            1e-9 * rows);
  EXPECT_LT((lower.bottomRightCorner(below, below) -
             Eigen::MatrixXd(schur.triangularView<Eigen::Lower>()))
                .norm(),
            1e-9 * rows);
}

TEST_P(FrontKernelsTest, ForwardAndBackwardSubstitutionSolve) {
  Eigen::MatrixXd matrix = random_matrix();
  ASSERT_TRUE(FrontKernels<3>::factorize(matrix.data(), rows, frontal));
  const Eigen::MatrixXd L11 = matrix.topLeftCorner(frontal, frontal).triangularView<Eigen::Lower>();
  const Eigen::MatrixXd L21 = matrix.bottomLeftCorner(below, frontal);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(rows, -1, 2);
  Eigen::VectorXd x = b;
  FrontKernels<3>::forward(matrix.data(), rows, frontal, x.data());
  EXPECT_LT((L11 * x.head(frontal) - b.head(frontal)).norm(), kRounding);
  EXPECT_LT((x.tail(below) + L21 * x.head(frontal) - b.tail(below)).norm(), kRounding);
  x = b;
  FrontKernels<3>::backward(matrix.data(), rows, frontal, x.data());
  EXPECT_LT((L11.transpose() * x.head(frontal) + L21.transpose() * b.tail(below) - b.head(frontal))
                .norm(),
            kRounding);
  EXPECT_EQ(x.tail(below), b.tail(below));
}

TEST_P(FrontKernelsTest, APivotThatIsNotPositiveIsRefused) {
  Eigen::MatrixXd matrix = random_matrix();
  matrix(frontal - 1, frontal - 1) = -1;
  EXPECT_FALSE(FrontKernels<3>::factorize(matrix.data(), rows, frontal));
}

}  // namespace front_assembly_test
}  // namespace placegraph
