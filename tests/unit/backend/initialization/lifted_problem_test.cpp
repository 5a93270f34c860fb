#include <gtest/gtest.h>
#include <placegraph/backend/initialization/lifted_problem.h>
#include <placegraph/graph/core/random.h>

#include <Eigen/QR>

#include "tests/support/scenes/pose_walk.h"

namespace placegraph {
namespace lifted_problem_test {

using test::Walk;

template <class Group>
class LiftedProblemOf : public testing::Test {
 protected:
  static constexpr int dim = kSpaceDim<Group>;
  using Problem = LiftedProblem<dim>;

  static Problem lifted(const Walk<Group>& walk) {
    return Problem(isotropic_problem(pack<Group>(walk.graph), RotationError::kLog));
  }
  static Eigen::MatrixXd random_matrix(int rank, int nodes, std::uint64_t seed) {
    Random random(seed);
    Eigen::MatrixXd M(rank, nodes * Problem::kBlock);
    for (double& x : M.reshaped()) x = random.normal(0, 1);
    return M;
  }
  /// On the manifold, anywhere.
  static Eigen::MatrixXd random_point(int rank, int nodes) {
    Eigen::MatrixXd X = random_matrix(rank, nodes, 5);
    for (int i = 0; i < nodes; ++i) {
      const Eigen::HouseholderQR<Eigen::MatrixXd> qr(Eigen::MatrixXd(Problem::Y(X, i)));
      Problem::Y(X, i) = Eigen::MatrixXd(qr.householderQ()).leftCols(dim);
    }
    return X;
  }
  static double inner(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
    return A.cwiseProduct(B).sum();
  }
};
using Groups = testing::Types<SE2, SE3>;
TYPED_TEST_SUITE(LiftedProblemOf, Groups);

TYPED_TEST(LiftedProblemOf, AtTheRankOfSpaceCostsWhatTheIsotropicProblemCosts) {
  using Lifted = typename TestFixture::Problem;
  const Walk<TypeParam> walk(20, 0.05);
  const Lifted lifted = TestFixture::lifted(walk);
  Eigen::MatrixXd X(TestFixture::dim, lifted.nodes() * Lifted::kBlock);
  for (int i = 0; i < lifted.nodes(); ++i) {
    Lifted::Y(X, i) = walk.truth[static_cast<std::size_t>(i)].rotation().matrix();
    Lifted::p(X, i) = walk.truth[static_cast<std::size_t>(i)].translation();
  }
  const double expected = isotropic_cost(lifted.isotropic(), walk.truth);
  EXPECT_GT(expected, 1);
  EXPECT_NEAR(lifted.cost(X), expected, 1e-9 * expected);
}

TYPED_TEST(LiftedProblemOf, IsAQuadraticFormWhoseGradientIsTwiceTheProduct) {
  const auto lifted = TestFixture::lifted(Walk<TypeParam>(20, 0.05));
  const int rank = TestFixture::dim + 2;
  const Eigen::MatrixXd X = TestFixture::random_matrix(rank, lifted.nodes(), 1),
                        V = TestFixture::random_matrix(rank, lifted.nodes(), 2);
  const double cost = lifted.cost(X);
  EXPECT_NEAR(TestFixture::inner(lifted.product(X), X), cost, 1e-9 * cost);
  const double slope = (lifted.cost(X + V) - lifted.cost(X - V)) / 2;
  EXPECT_NEAR(slope, 2 * TestFixture::inner(lifted.product(X), V), 1e-9 * cost);
}

TYPED_TEST(LiftedProblemOf, ProjectsOntoTangentVectors) {
  using Lifted = typename TestFixture::Problem;
  const auto lifted = TestFixture::lifted(Walk<TypeParam>(20, 0.05));
  const int rank = TestFixture::dim + 1;
  const Eigen::MatrixXd X = TestFixture::random_point(rank, lifted.nodes()),
                        any = TestFixture::random_matrix(rank, lifted.nodes(), 3);
  Eigen::MatrixXd V = any;
  lifted.project(X, V);
  for (int i = 0; i < lifted.nodes(); ++i) {
    const Eigen::MatrixXd skew = Lifted::Y(X, i).transpose() * Lifted::Y(V, i);
    EXPECT_LT((skew + skew.transpose()).norm(), 1e-12);
    EXPECT_EQ(Lifted::p(V, i), Lifted::p(any, i));
  }
  // What was taken off is at right angles to all tangent vectors, those along the rotations too.
  EXPECT_NEAR(TestFixture::inner(any - V, V), 0, 1e-10);
  Eigen::MatrixXd gauge_motion = Eigen::MatrixXd::Zero(rank, X.cols());
  for (int i = 0; i < lifted.nodes(); ++i) {
    const Eigen::MatrixXd S =
        TestFixture::random_matrix(TestFixture::dim, 1, 8 + i).leftCols(TestFixture::dim);
    Lifted::Y(gauge_motion, i) = Lifted::Y(X, i) * (S - S.transpose());
  }
  EXPECT_NEAR(TestFixture::inner(any - V, gauge_motion), 0, 1e-10 * gauge_motion.norm());
}

TYPED_TEST(LiftedProblemOf, RetractsToTheManifoldAlongTheTangentVector) {
  using Lifted = typename TestFixture::Problem;
  const auto lifted = TestFixture::lifted(Walk<TypeParam>(20, 0.05));
  const int rank = TestFixture::dim + 1;
  const Eigen::MatrixXd X = TestFixture::random_point(rank, lifted.nodes());
  Eigen::MatrixXd V = TestFixture::random_matrix(rank, lifted.nodes(), 4);
  lifted.project(X, V);
  constexpr double kStep = 1e-4;
  const Eigen::MatrixXd far = lifted.retract(X, V), near = lifted.retract(X, kStep * V);
  for (int i = 0; i < lifted.nodes(); ++i) {
    const Eigen::MatrixXd gram = Lifted::Y(far, i).transpose() * Lifted::Y(far, i);
    EXPECT_LT((gram - Eigen::MatrixXd::Identity(TestFixture::dim, TestFixture::dim)).norm(), 1e-12);
    const double off = ((Lifted::Y(near, i) - Lifted::Y(X, i)) / kStep - Lifted::Y(V, i)).norm();
    EXPECT_LT(off, 20 * kStep * (1 + Lifted::Y(V, i).squaredNorm()));
  }
}

TYPED_TEST(LiftedProblemOf, TranslationsThatAreSolvedForLeaveNoGradient) {
  using Lifted = typename TestFixture::Problem;
  const auto lifted = TestFixture::lifted(Walk<TypeParam>(20, 0.05));
  Eigen::MatrixXd X = TestFixture::random_point(TestFixture::dim + 1, lifted.nodes());
  const double before = lifted.cost(X);
  lifted.solve_translations(X);
  EXPECT_LT(lifted.cost(X), before);
  const Eigen::MatrixXd XQ = lifted.product(X);
  EXPECT_LT(Lifted::p(X, 0).norm(), 1e-9);
  for (int i = 0; i < lifted.nodes(); ++i) EXPECT_LT(Lifted::p(XQ, i).norm(), 1e-9 * XQ.norm());
}

TYPED_TEST(LiftedProblemOf, TheHessianIsTheCurvatureOfTheCostAlongTheManifold) {
  using Lifted = typename TestFixture::Problem;
  const auto lifted = TestFixture::lifted(Walk<TypeParam>(20, 0.05));
  const int rank = TestFixture::dim + 1;
  const Eigen::MatrixXd X = TestFixture::random_point(rank, lifted.nodes());
  Eigen::MatrixXd V = TestFixture::random_matrix(rank, lifted.nodes(), 6);
  lifted.project(X, V);
  const auto cost_at = [&](double length) {  // with translations that go straight on
    const Eigen::MatrixXd straight = X + length * V;
    Eigen::MatrixXd moved = lifted.retract(X, length * V);
    for (int i = 0; i < lifted.nodes(); ++i) Lifted::p(moved, i) = Lifted::p(straight, i);
    return lifted.cost(moved);
  };
  constexpr double kStep = 1e-3;
  const double curvature = (cost_at(kStep) - 2 * cost_at(0) + cost_at(-kStep)) / (kStep * kStep);
  const auto lambda = lifted.multipliers(X, lifted.product(X));
  const double expected = 2 * TestFixture::inner(V, lifted.hessian(X, lambda, V));
  EXPECT_NEAR(curvature, expected, 1e-4 * std::abs(expected));
  // It is symmetric, and a tangent vector.
  Eigen::MatrixXd W = TestFixture::random_matrix(rank, lifted.nodes(), 7);
  lifted.project(X, W);
  Eigen::MatrixXd H_V = lifted.hessian(X, lambda, V);
  EXPECT_NEAR(TestFixture::inner(W, H_V), TestFixture::inner(V, lifted.hessian(X, lambda, W)),
              1e-9 * H_V.norm() * W.norm());
  const Eigen::MatrixXd before = H_V;
  lifted.project(X, H_V);
  EXPECT_LT((H_V - before).norm(), 1e-12 * before.norm());
}

}  // namespace lifted_problem_test
}  // namespace placegraph
