#include <gtest/gtest.h>
#include <placegraph/frontend/align/warp.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>

#include "tests/support/seed.h"

namespace placegraph {
namespace planar_warp_test {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::seeded_random;

Matrix3d camera_matrix() {
  Matrix3d K;
  K << 300, 0, 160, 0, 310, 120, 0, 0, 1;
  return K;
}

const Plane kPlane{Vector3d(0.1, 0.9, 0.5).normalized(), 1.7};

std::vector<PlanarWarp> warps() {
  Matrix3d H;
  H << 1.1, 0.05, 7, -0.02, 0.95, -4, 1e-4, -2e-4, 1;
  return {PlanarWarp::homography(H, {150, 110}, 50),
          PlanarWarp::rigid_motion(
              camera_matrix(),
              SE3::exp((Vector6d() << 0.1, 0.05, -0.2, 0.02, 0.1, -0.05).finished()), kPlane),
          PlanarWarp::planar_motion(camera_matrix(), SE2(0.3, -0.1, 0.2), kPlane)};
}

TEST(PlanarWarp, HasGeneratorsThatAgreeWithFiniteDifferences) {
  for (const PlanarWarp& warp : warps()) {
    const PlanarWarp::Generators A = warp.generators();
    ASSERT_EQ(A.cols(), warp.dof());
    for (int k = 0; k < warp.dof(); ++k) {
      const double h = 1e-5;
      const auto at = [&](double step) {
        return warp.plus(Eigen::VectorXd::Unit(warp.dof(), k) * step).H_cur_ref();
      };
      const Matrix3d numeric = warp.H_cur_ref().inverse() * (at(h) - at(-h)) / (2 * h);
      Matrix3d analytic;
      analytic << A.col(k).segment<3>(0).transpose(), A.col(k).segment<3>(3).transpose(),
          A.col(k).segment<3>(6).transpose();
      // Central differences err by h^2 times third derivatives, far below this share.
      EXPECT_LT((numeric - analytic).norm(), 1e-6 * (1 + analytic.norm()))
          << "kind " << static_cast<int>(warp.kind()) << ", parameter " << k;
    }
  }
}

TEST(PlanarWarp, ComposesStepsWhereItsFamilyIsAGroup) {
  // Homographies and motions along the plane: there and back is the identity.
  Random random = seeded_random(71);
  for (const PlanarWarp& warp : {warps()[0], warps()[2]}) {
    PlanarWarp::Step x(warp.dof());
    for (int k = 0; k < warp.dof(); ++k) x[k] = random.uniform(-0.2, 0.2);
    const Matrix3d back = warp.plus(x).plus(-x).H_cur_ref();
    EXPECT_LT((back - warp.H_cur_ref()).norm(), 1e-9 * warp.H_cur_ref().norm());
  }
}

TEST(PlanarWarp, OfARigidMotionIsThePlanesHomography) {
  const PlanarWarp warp = warps()[1];
  const Vector3d X = 1.7 / kPlane.normal.dot(Vector3d(0.2, 0.8, 1)) * Vector3d(0.2, 0.8, 1);
  const Matrix3d K = camera_matrix();
  const Eigen::Vector2d ref = (K * X).hnormalized();
  const Eigen::Vector2d cur = (K * (*warp.T_cur_ref() * X)).hnormalized();
  const auto mapped = map_pixel(warp.H_cur_ref(), ref);
  ASSERT_TRUE(mapped);
  EXPECT_LT((*mapped - cur).norm(), 1e-9);
  EXPECT_FALSE(warp.planar_T_cur_ref());
  EXPECT_FALSE(warps()[0].T_cur_ref());
}

TEST(PlanarWarp, AlongThePlaneKeepsDistanceAndNormal) {
  const PlanarWarp warp = warps()[2];
  const Plane moved = transform(*warp.T_cur_ref(), kPlane);
  EXPECT_NEAR(moved.distance_m, kPlane.distance_m, 1e-12);
  EXPECT_LT((moved.normal - kPlane.normal).norm(), 1e-12);
  EXPECT_NEAR(warp.T_cur_ref()->translation().norm(), std::hypot(0.3, 0.1), 1e-12);
  EXPECT_NEAR(warp.T_cur_ref()->rotation().log().dot(kPlane.normal), 0.2, 1e-12);
}

TEST(PlanarWarp, ExponentialOfATracelessMatrixHasDeterminantOne) {
  Matrix3d A;
  A << 1, 2, 3, 4, -3, 1, 0.5, 0.2, 2;
  EXPECT_NEAR(sl3_exp(A).determinant(), 1, 1e-9);
  EXPECT_LT((sl3_exp(A) * sl3_exp(-A) - Matrix3d::Identity()).norm(), 1e-8);
  Matrix3d shift = Matrix3d::Zero();  // nilpotent: exp = I + A
  shift(0, 2) = 5, shift(1, 2) = -3;
  EXPECT_LT((sl3_exp(shift) - Matrix3d::Identity() - shift).norm(), 1e-12);
}

TEST(PlanarWarp, RefusesWhatIsNoWarp) {
  EXPECT_THROW((void)PlanarWarp::homography(Matrix3d::Zero(), {0, 0}, 1), ArgumentError);
  EXPECT_THROW((void)PlanarWarp::homography(Matrix3d::Identity(), {0, 0}, 0), ArgumentError);
  EXPECT_THROW((void)PlanarWarp::rigid_motion(camera_matrix(), SE3(), {Vector3d::UnitZ(), -1}),
               ArgumentError);
  EXPECT_THROW((void)PlanarWarp::planar_motion(camera_matrix(), SE2(), {Vector3d(0, 0, 2), 1}),
               ArgumentError);
  EXPECT_THROW((void)PlanarWarp().plus(PlanarWarp::Step::Zero(3)), ArgumentError);
}

TEST(PlanarWarp, MapsNoPixelBeyondTheHorizon) {
  Matrix3d H = Matrix3d::Identity();
  H(2, 0) = -0.01;
  EXPECT_TRUE(map_pixel(H, {99, 0}));
  EXPECT_FALSE(map_pixel(H, {101, 0}));
}

}  // namespace planar_warp_test
}  // namespace placegraph
