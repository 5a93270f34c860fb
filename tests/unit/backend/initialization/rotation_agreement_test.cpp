#include <gtest/gtest.h>
#include <placegraph/backend/initialization/rotation_agreement.h>

#include <limits>

#include "tests/support/scenes/pose_walk.h"

namespace placegraph {
namespace rotation_agreement_test {

/// A turn by `angle_rad` about the last axis.
template <class Group>
Group rotation(double angle_rad) {
  typename Group::Tangent xi = Group::Tangent::Zero();
  xi[Group::kDof == 3 ? 2 : 5] = angle_rad;
  return Group::exp(xi);
}

template <class Group>
class RotationAgreementOf : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(RotationAgreementOf, Groups);

TYPED_TEST(RotationAgreementOf, AgreesUpToThreeTenthsOfARadianAndNoFurther) {
  Random random(1);
  std::vector<TypeParam> a, near, far;
  for (int i = 0; i < 5; ++i) {
    a.push_back(test::random_element<TypeParam>(random, 5, 2));
    near.push_back(a.back() * rotation<TypeParam>(i == 3 ? 0.29 : 0));
    far.push_back(a.back() * rotation<TypeParam>(i == 3 ? -0.32 : 0));
  }
  EXPECT_TRUE(rotations_agree(a, a));
  EXPECT_TRUE(rotations_agree(a, near));
  EXPECT_FALSE(rotations_agree(a, far));
}

TYPED_TEST(RotationAgreementOf, IsNotDisturbedByACommonRotationNorByTranslations) {
  Random random(2);
  std::vector<TypeParam> a, b;
  const TypeParam T_b_a = test::random_element<TypeParam>(random, 10, 2);
  for (int i = 0; i < 5; ++i) {
    a.push_back(test::random_element<TypeParam>(random, 5, 2));
    b.push_back(T_b_a * a.back() * test::random_element<TypeParam>(random, 3, 0));
  }
  EXPECT_TRUE(rotations_agree(a, b));
}

TYPED_TEST(RotationAgreementOf, WhatIsNotFiniteAgreesWithNothing) {
  // Turned by next to nothing, but by an angle that is not a number.
  std::vector<TypeParam> a(2), b(2);
  b[1] = rotation<TypeParam>(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(rotations_agree(a, b));
}

TEST(RotationAgreement, CosineOfARotationIsThatOfItsAngle) {
  for (const double angle_rad : {0.0, 0.3, -1.2, 3.0}) {
    EXPECT_NEAR(cosine_of(SO2(angle_rad)), std::cos(angle_rad), 1e-15);
    EXPECT_NEAR(cosine_of(SO3::exp({angle_rad, 0, 0})), std::cos(angle_rad), 1e-15);
  }
}

TEST(RotationAgreement, PointsOfRankDAgreeWhereTheirRotationsDo) {
  // Columns: [rotation, translation] of two nodes; the second one turned.
  const auto point = [](double angle_rad) {
    Eigen::MatrixXd X(3, 8);
    X << Eigen::Matrix3d::Identity(), Eigen::Vector3d::Constant(7),
        SO3::exp({0, angle_rad, 0}).matrix(), Eigen::Vector3d::Constant(angle_rad);
    return X;
  };
  EXPECT_TRUE(points_agree<3>(point(0), point(0.29)));
  EXPECT_FALSE(points_agree<3>(point(0), point(0.32)));
  EXPECT_TRUE(points_agree<3>(point(0.32), point(0.61)));
}

}  // namespace rotation_agreement_test
}  // namespace placegraph
