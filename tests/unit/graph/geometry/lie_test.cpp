#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/geometry/lie.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace placegraph {
namespace lie_test {

using std::numbers::pi;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Hat, IsTheCrossProduct) {
  const Eigen::Vector3d a(1, 2, 3), b(-4, 5, 6);
  EXPECT_EQ(hat(a) * b, a.cross(b));
}

TEST(SO2, RightAngleTakesXToY) {
  EXPECT_NEAR((SO2(pi / 2) * Eigen::Vector2d(1, 0) - Eigen::Vector2d(0, 1)).norm(), 0, 1e-15);
}

TEST(SO2, AngleOfARotationByPiIsPlusPi) {
  EXPECT_DOUBLE_EQ(SO2(pi).angle(), pi);
  EXPECT_DOUBLE_EQ(SO2(-pi).angle(), pi);
  EXPECT_NEAR(SO2(3 * pi + 0.25).angle(), -pi + 0.25, 1e-14);
}

TEST(SO3, RightAngleAboutZTakesXToY) {
  const SO3 R = SO3::exp({0, 0, pi / 2});
  EXPECT_NEAR((R * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(0, 1, 0)).norm(), 0, 1e-15);
}

TEST(SO3, NormalizesTheQuaternionItIsGiven) {
  const SO3 R(Eigen::Quaterniond(0, 0, 0, -7));
  EXPECT_DOUBLE_EQ(R.quaternion().norm(), 1);
  EXPECT_NEAR(R.log().norm(), pi, 1e-15);
}

TEST(SO3, RefusesAQuaternionThatIsNoRotation) {
  EXPECT_THROW(SO3(Eigen::Quaterniond(0, 0, 0, 0)), ArgumentError);
  EXPECT_THROW(SO3(Eigen::Quaterniond(kNaN, 0, 0, 1)), ArgumentError);
  EXPECT_THROW(SO3(Eigen::Quaterniond(std::numeric_limits<double>::infinity(), 0, 0, 1)),
               ArgumentError);
}

TEST(SO3, BothSignsOfTheQuaternionHaveOneLogarithm) {
  const Eigen::Quaterniond q(0.8, 0.1, -0.5, 0.3);
  const Eigen::Quaterniond opposite(-q.w(), -q.x(), -q.y(), -q.z());
  EXPECT_EQ(SO3(q).log(), SO3(opposite).log());
}

TEST(SO3, FromMatrixTakesTheNearestRotation) {
  const Eigen::Matrix3d R = SO3::exp({0.3, -2, 1}).matrix();
  // A symmetric stretch: its polar factor, the nearest rotation, is R.
  Eigen::Matrix3d stretch = Eigen::Matrix3d::Identity();
  stretch.diagonal() << 1.004, 0.997, 1.001;
  EXPECT_NEAR((SO3::from_matrix(R * stretch).matrix() - R).norm(), 0, 1e-14);
}

TEST(SO3, FromMatrixKeepsSevenDigitMatrices) {
  const Eigen::Matrix3d R = SO3::exp({pi - 1e-3, 0, 1e-2}).matrix();
  const Eigen::Matrix3d rounded = (R * 1e7).array().round() / 1e7;
  EXPECT_LT((SO3::from_matrix(rounded).matrix() - R).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(SO3, FromMatrixRefusesWhatIsNoRotation) {
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  EXPECT_NO_THROW(SO3::from_matrix(1.004 * I));              // R^T R - I = 0.008
  EXPECT_THROW(SO3::from_matrix(1.006 * I), ArgumentError);  // 0.012
  EXPECT_THROW(SO3::from_matrix(Eigen::Matrix3d::Zero()), ArgumentError);
  EXPECT_THROW(SO3::from_matrix(kNaN * I), ArgumentError);
  const Eigen::Matrix3d mirror = Eigen::Vector3d(1, 1, -1).asDiagonal();
  EXPECT_THROW(SO3::from_matrix(mirror), ArgumentError);
}

TEST(SE2, TranslationOfAQuarterCircleIsItsChord) {
  // Unit speed along x while turning by pi / 2: a circle of radius 2 / pi.
  const SE2 T = SE2::exp({1, 0, pi / 2});
  EXPECT_NEAR((T.translation() - Eigen::Vector2d(2 / pi, 2 / pi)).norm(), 0, 1e-15);
}

TEST(SE3, TranslationOfAHalfCircleIsItsDiameter) {
  Vector6d xi;
  xi << 1, 0, 0, 0, 0, pi;
  EXPECT_NEAR((SE3::exp(xi).translation() - Eigen::Vector3d(0, 2 / pi, 0)).norm(), 0, 1e-15);
}

TEST(SE3, ComposesFramesByTheMonogramRule) {
  const SE3 T_a_b(SO3::exp({0, 0, pi / 2}), {1, 0, 0});
  const SE3 T_b_c(SO3(), {2, 0, 0});
  EXPECT_NEAR(((T_a_b * T_b_c).translation() - Eigen::Vector3d(1, 2, 0)).norm(), 0, 1e-15);
}

TEST(SE3, IsometryGoesThereAndBack) {
  Vector6d xi;
  xi << 1, -2, 3, 0.4, 0.5, -2.6;
  const SE3 T = SE3::exp(xi);
  EXPECT_NEAR((SE3(T.isometry()).log() - xi).norm(), 0, 1e-14);
  EXPECT_EQ(T.isometry().matrix(), T.matrix());
}

TEST(Sim3, PureScaleMovesTheOriginByTheMeanOfItsGrowth) {
  Vector7d xi;
  xi << 1, 0, 0, 0, 0, 0, std::log(3);
  const Sim3 S = Sim3::exp(xi);
  EXPECT_NEAR(S.scale(), 3, 1e-15);
  EXPECT_NEAR(S.translation()[0], 2 / std::log(3), 1e-15);  // integral of 3^tau over [0, 1]
  EXPECT_NEAR((S * Eigen::Vector3d(0, 1, 0))[1], 3, 1e-15);
}

TEST(Sim3, WithoutScaleIsTheRigidMotion) {
  Vector6d xi;
  xi << 1, -2, 3, 0.4, 0.5, -2.6;
  Vector7d xi_sim;
  xi_sim << xi, 0;
  EXPECT_NEAR((Sim3(SE3::exp(xi)).matrix() - Sim3::exp(xi_sim).matrix()).norm(), 0, 1e-14);
  EXPECT_NEAR((Sim3::right_jacobian(xi_sim).topLeftCorner<6, 6>() - SE3::right_jacobian(xi)).norm(),
              0, 1e-14);
}

TEST(Sim3, RefusesAScaleThatIsNotPositive) {
  for (const double scale : {0.0, -1.0, kNaN, std::numeric_limits<double>::infinity()})
    EXPECT_THROW(Sim3(SO3(), Eigen::Vector3d::Zero(), scale), ArgumentError) << scale;
}

}  // namespace lie_test
}  // namespace placegraph
