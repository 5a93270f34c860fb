#include <gtest/gtest.h>
#include <placegraph/backend/linear/marginalization.h>
#include <placegraph/graph/core/random.h>

#include <Eigen/Dense>

namespace placegraph {
namespace marginalization_test {

/// Normal equations of `rows` random measurements of `n` variables.
QuadraticForm random_form(int rows, int n, std::uint64_t seed) {
  Random random(seed);
  Eigen::MatrixXd J(rows, n);
  Eigen::VectorXd r(rows);
  for (Eigen::Index i = 0; i < J.size(); ++i) J.data()[i] = random.normal();
  for (Eigen::Index i = 0; i < rows; ++i) r[i] = random.normal();
  return {J.transpose() * J, J.transpose() * r};
}

TEST(Marginalization, LeavesTheMinimumOfTheOtherVariablesWhereItWas) {
  const QuadraticForm form = random_form(20, 9, 1);
  const Eigen::VectorXd x = form.H.ldlt().solve(-form.b);
  const QuadraticForm rest = marginalize_first(form, 4);
  EXPECT_LT((rest.H.ldlt().solve(-rest.b) - x.tail(5)).norm(), 1e-10);
  // Its inverse is the block of the joint covariance.
  EXPECT_LT((rest.H.inverse() - form.H.inverse().bottomRightCorner(5, 5)).norm(), 1e-10);
}

TEST(Marginalization, IgnoresDirectionsWithoutInformation) {
  QuadraticForm form = random_form(20, 6, 2);
  QuadraticForm wider{Eigen::MatrixXd::Zero(8, 8), Eigen::VectorXd::Zero(8)};
  wider.H.bottomRightCorner(6, 6) = form.H;
  wider.b.tail(6) = form.b;
  const QuadraticForm expected = marginalize_first(form, 2);
  const QuadraticForm rest = marginalize_first(wider, 4);
  EXPECT_LT((rest.H - expected.H).norm(), 1e-10);
  EXPECT_LT((rest.b - expected.b).norm(), 1e-10);
}

TEST(Marginalization, CountsWhatCancellationLeavesAsNothing) {
  QuadraticForm form = random_form(20, 3, 3);
  form.H(0, 0) = 1e-9;  // rounding of sums of size 1e6 ...
  form.H(0, 1) = form.H(1, 0) = 1e-6;
  const Eigen::VectorXd reference = Eigen::VectorXd::Constant(1, 1e6);
  EXPECT_EQ(marginalize_first(form, 1, &reference).H, form.H.bottomRightCorner(2, 2));
  // ... which without that knowledge would count as information.
  EXPECT_GT((marginalize_first(form, 1).H - form.H.bottomRightCorner(2, 2)).norm(), 1e-4);
}

TEST(Marginalization, SquareRootReproducesTheFormAtFullAndAtDeficientRank) {
  for (const int rows : {12, 4}) {
    QuadraticForm form = random_form(rows, 7, 4);
    // Units that differ as metres and radians over a long lever arm do.
    Eigen::VectorXd units(7);
    units << 1e-3, 1, 1e3, 1, 1e2, 1e-2, 1;
    form.H = units.asDiagonal() * form.H * units.asDiagonal();
    form.b = units.asDiagonal() * form.b;
    const SquareRootForm root = square_root(form);
    EXPECT_EQ(root.J.rows(), std::min(rows, 7));
    const Eigen::VectorXd inverse = units.cwiseInverse();
    EXPECT_LT((inverse.asDiagonal() * (root.J.transpose() * root.J - form.H) * inverse.asDiagonal())
                  .norm(),
              1e-9);
    EXPECT_LT((inverse.asDiagonal() * (root.J.transpose() * root.e - form.b)).norm(), 1e-9);
  }
}

TEST(Marginalization, ClampingLeavesGoodMatricesAndRemovesNegativeDirections) {
  const Eigen::MatrixXd H = random_form(20, 6, 5).H;
  EXPECT_LT((clamp_to_semidefinite(H, 1e-9) - H).norm(), 1e-10);
  Eigen::MatrixXd low = random_form(4, 6, 6).H;
  const Eigen::VectorXd null = low.fullPivLu().kernel().col(0).normalized();
  const Eigen::MatrixXd clamped =
      clamp_to_semidefinite(low - 1e-12 * null * null.transpose(), 1e-9);
  EXPECT_LT((clamped - low).norm(), 1e-9);
  EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(clamped).eigenvalues()[0], -1e-13);
}

}  // namespace marginalization_test
}  // namespace placegraph
