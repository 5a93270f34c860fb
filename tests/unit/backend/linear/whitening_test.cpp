#include <gtest/gtest.h>
#include <placegraph/backend/linear/relative_covariance.h>
#include <placegraph/backend/linear/whitening.h>

#include "tests/support/packed_graphs.h"

namespace placegraph {
namespace whitening_test {

TEST(Whitening, IsARootOfTheInformationOfAnyRank) {
  Random random(1);
  for (int rank = 0; rank <= 6; ++rank)
    for (const double scale : {1e-8, 1.0, 1e8}) {
      Matrix6d J = Matrix6d::Zero();
      for (double& entry : J.topRows(rank).reshaped()) entry = random.normal();
      // Positive semi-definite exactly, so that rounding decides how the root is found.
      const Matrix6d information = scale * (J.transpose() * J);
      const Matrix6d W = whitening(information);
      EXPECT_LT((W.transpose() * W - information).norm(), 1e-12 * information.norm() + 1e-300)
          << "rank " << rank << " scale " << scale;
    }
}

TEST(Whitening, SaysWhereARankIsNotFull) {
  const auto deficient = [](const Eigen::Vector3d& information) {
    bool result = false;
    (void)whitening(Eigen::Matrix3d(information.asDiagonal()), &result);
    return result;
  };
  EXPECT_FALSE(deficient({1, 2, 3}));
  EXPECT_FALSE(deficient({1e-9, 2e-9, 3e-9}));
  EXPECT_FALSE(deficient({1, 1e-10, 1}));  // a hundred thousand times the deviation
  EXPECT_TRUE(deficient({1, 1e-13, 1}));
  EXPECT_TRUE(deficient({1, 0, 1}));
  EXPECT_TRUE(deficient({0, 0, 0}));
  // What was found before is kept.
  bool seen = true;
  (void)whitening(Eigen::Matrix3d(Eigen::Matrix3d::Identity()), &seen);
  EXPECT_TRUE(seen);
}

TEST(Whitening, LeavesOutDirectionsThatRoundingMadeNegative) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 2) / 3;
  const Eigen::Matrix3d information =
      Eigen::Matrix3d::Identity() - (1 + 1e-12) * axis * axis.transpose();
  const Eigen::Matrix3d W = whitening(information);
  EXPECT_TRUE(W.allFinite());
  EXPECT_LT((W * axis).norm(), 1e-11);
  EXPECT_LT((W.transpose() * W - information).norm(), 2e-12);
}

template <class Group>
class RelativeCovarianceOf : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(RelativeCovarianceOf, Groups);

TYPED_TEST(RelativeCovarianceOf, IsTheJointOnePropagatedByDifferences) {
  constexpr int dof = TypeParam::kDof;
  Random random(2);
  const auto T_world_from = test::random_element<TypeParam>(random, 2, 1);
  const auto T_world_to = test::random_element<TypeParam>(random, 2, 1);
  const TypeParam T_to_from = T_world_to.inverse() * T_world_from;
  const Eigen::MatrixXd joint = test::random_information(2 * dof, random);
  Eigen::MatrixXd J(dof, 2 * dof);
  constexpr double kStep = 1e-4;
  for (int i = 0; i < 2 * dof; ++i) {
    typename TypeParam::Tangent moved[2];
    for (const int side : {0, 1}) {
      const Eigen::Matrix<double, 2 * dof, 1> xi =
          Eigen::Matrix<double, 2 * dof, 1>::Unit(i) * (side ? kStep : -kStep);
      const TypeParam T_from_to = T_world_from.plus(xi.template head<dof>()).inverse() *
                                  T_world_to.plus(xi.template tail<dof>());
      moved[side] = (T_to_from * T_from_to).log();
    }
    J.col(i) = (moved[1] - moved[0]) / (2 * kStep);
  }
  const Eigen::MatrixXd expected = J * joint * J.transpose();
  const Information covariance = relative_covariance(
      T_to_from.adjoint(), joint.template topLeftCorner<dof, dof>(),
      joint.template bottomRightCorner<dof, dof>(), joint.template topRightCorner<dof, dof>());
  // The differences are good to the square of their step.
  EXPECT_LT((covariance - expected).norm(), 1e-6 * expected.norm());
  EXPECT_EQ(covariance, Information(covariance.transpose()));
}

}  // namespace whitening_test
}  // namespace placegraph
