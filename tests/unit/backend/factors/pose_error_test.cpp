#include <gtest/gtest.h>
#include <placegraph/backend/factors/inverse_depth.h>
#include <placegraph/backend/factors/point_in_node.h>
#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/backend/factors/position_error.h>
#include <placegraph/backend/factors/reprojection.h>

#include <limits>

#include "tests/support/scenes/pose_walk.h"

namespace placegraph {
namespace pose_error_test {

template <class Group>
class PoseErrorOf : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(PoseErrorOf, Groups);

TYPED_TEST(PoseErrorOf, IsHalfTheRotationInTheOtherConventionForSmallErrors) {
  Random random(1);
  for (const double size : {1e-2, 1e-4}) {
    const auto E = test::random_element<TypeParam>(random, size, size);
    auto e = pose_error(E, RotationError::kLog);
    if constexpr (TypeParam::kDof > 3) e.template segment<3>(3) *= 0.5;
    EXPECT_LT((pose_error(E, RotationError::kQuaternion) - e).norm(), 10 * size * size);
    EXPECT_LT((pose_error(E, RotationError::kLog) + E.inverse().log()).norm(), 1e-14);
  }
  for (const RotationError kind : {RotationError::kLog, RotationError::kQuaternion})
    EXPECT_EQ(pose_error(TypeParam(), kind).norm(), 0);
}

TYPED_TEST(PoseErrorOf, DoesNotChangeWhenBothPosesMoveWithTheWorld) {
  Random random(2);
  for (const RotationError kind : {RotationError::kLog, RotationError::kQuaternion})
    for (int trial = 0; trial < 10; ++trial) {
      const auto T_world_from = test::random_element<TypeParam>(random, 2, 1);
      const auto T_world_to = test::random_element<TypeParam>(random, 2, 1);
      const auto T_to_from =
          test::random_element<TypeParam>(random, 0.2, 0.2) * T_world_to.inverse() * T_world_from;
      const RelativePoseLinearization<TypeParam> at(T_to_from, T_world_from, T_world_to, kind);
      // Exp(xi) T = T Exp(Ad(T^-1) xi): the derivative by a motion of the world is zero.
      const typename TypeParam::Jacobian by_world =
          at.J_from * T_world_from.inverse().adjoint() + at.J_to * T_world_to.inverse().adjoint();
      EXPECT_LT(by_world.norm(), 1e-11 * T_world_to.inverse().adjoint().norm());
    }
}

TYPED_TEST(PoseErrorOf, OfAPositionIsThatOfAPointSeenFromTheNode) {
  constexpr int dim = TypeParam::kDof == 3 ? 2 : 3;
  Random random(3);
  const auto T_world_node = test::random_element<TypeParam>(random, 2, 1);
  const Eigen::Vector3d p_node(0.4, -0.3, dim == 2 ? 0 : 0.7), p_world(2, 1, dim == 2 ? 0 : -1);
  const PositionLinearization<TypeParam> in_world(T_world_node, p_node, p_world);
  const PointLinearization<TypeParam> in_node(T_world_node, p_world, p_node);
  using Point = Eigen::Matrix<double, dim, 1>;
  const auto rotated = [&](const Point& p) {
    return Point(T_world_node * p - T_world_node.translation());
  };
  const Point expected = rotated(-in_node.e.template head<dim>());
  EXPECT_LT((in_world.e.template head<dim>() - expected).norm(), 1e-12);
  constexpr double kStep = 1e-5;
  for (int i = 0; i < TypeParam::kDof; ++i) {
    Eigen::Vector3d of_position[2], by_node[2], by_point[2];
    for (const int side : {0, 1}) {
      const typename TypeParam::Tangent xi = TypeParam::Tangent::Unit(i) * (side ? kStep : -kStep);
      const TypeParam moved = T_world_node.plus(xi);
      of_position[side] = PositionLinearization<TypeParam>(moved, p_node, p_world).e;
      by_node[side] = PointLinearization<TypeParam>(moved, p_world, p_node).e;
      Eigen::Vector3d p = p_world;  // the tangent of a point turns nothing
      if (i < dim) p[i] += xi[i];
      by_point[side] = PointLinearization<TypeParam>(T_world_node, p, p_node).e;
    }
    // The differences are good to rounding over the step.
    EXPECT_LT((in_world.J.col(i) - (of_position[1] - of_position[0]) / (2 * kStep)).norm(), 1e-9);
    EXPECT_LT((in_node.J_node.col(i) - (by_node[1] - by_node[0]) / (2 * kStep)).norm(), 1e-9);
    EXPECT_LT((in_node.J_point.col(i) - (by_point[1] - by_point[0]) / (2 * kStep)).norm(), 1e-9);
  }
}

Camera camera() {
  Camera camera;
  camera.fx = 500, camera.fy = 480, camera.cx = 320, camera.cy = 240;
  return camera;
}

TEST(ReprojectionMeasurement, WhitensItsCovariance) {
  Random random(4);
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::Matrix2d root;
    for (double& entry : root.reshaped()) entry = random.normal();
    const Eigen::Matrix2d covariance = root * root.transpose() + Eigen::Matrix2d::Identity();
    const Reprojection reprojection(camera(), {300, 200}, covariance);
    Eigen::Matrix2d W;
    W << reprojection.whiten({1, 0}), reprojection.whiten({0, 1});
    EXPECT_LT((W * covariance * W.transpose() - Eigen::Matrix2d::Identity()).norm(), 1e-12);
  }
  const Reprojection by_sigma(camera(), {300, 200}, 0.5);
  const Reprojection by_covariance(camera(), {300, 200}, 0.25 * Eigen::Matrix2d::Identity());
  const Eigen::Vector3d p_cam(1, -2, 7);
  EXPECT_LT((by_sigma.residual(p_cam) - by_covariance.residual(p_cam)).norm(), 1e-12);
  EXPECT_LT((by_sigma.derivative(p_cam) - by_covariance.derivative(p_cam)).norm(), 1e-12);
}

TEST(ReprojectionMeasurement, DoesNotKnowHowFarAPointIs) {
  const Reprojection reprojection(camera(), {300, 200}, 0.5);
  const InverseDepth depth(0.2, 0.01);
  for (const double z : {0.5, 3.0, 100.0}) {
    const Eigen::Vector3d p_cam = z * Eigen::Vector3d(0.2, -0.1, 1);
    EXPECT_LT((reprojection.residual(p_cam) - reprojection.residual(2 * p_cam)).norm(), 1e-10);
    EXPECT_LT((reprojection.derivative(p_cam) * p_cam).norm(), 1e-10);
    // The inverse depth falls by its own size a relative step along the ray.
    EXPECT_NEAR((depth.derivative(p_cam) * p_cam)[0], -1 / (z * 0.01), 1e-9 / z);
    EXPECT_TRUE(depth.derivative(p_cam).leftCols<2>().isZero(0));
  }
}

TEST(PointInCamera, IsThatOfThePoseAndProjectableInFrontAndNotTooFar) {
  const SE3 T_map_cam(SO3::exp({0.3, -0.5, 0.2}), Eigen::Vector3d(1, -2, 0.5));
  const Eigen::Vector3d p_map(3, 1, 4), p_cam = T_map_cam.inverse() * p_map;
  double pose[7];
  VariableBlock<SE3>::store(T_map_cam, pose);
  Eigen::Matrix3d R;
  EXPECT_LT((PointInCamera(pose, p_map.data(), R).p_cam - p_cam).norm(), 1e-14);
  EXPECT_LT((R - T_map_cam.rotation().matrix()).norm(), 1e-14);
  EXPECT_LT((PointInCamera(R, T_map_cam.translation(), p_map).p_cam - p_cam).norm(), 1e-14);
  const auto projectable = [](double z) {
    return PointInCamera(Eigen::Matrix3d::Identity(), {0, 0, 0}, {1, 1, z}).projectable();
  };
  for (const double z : {2e-4, 1.0, 0.9e12}) EXPECT_TRUE(projectable(z)) << z;
  for (const double z : {-1.0, 0.0, 0.5e-4, 1.1e12, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_FALSE(projectable(z)) << z;
}

}  // namespace pose_error_test
}  // namespace placegraph
