#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/geometry/plane3.h>

#include <Eigen/LU>
#include <cmath>

namespace placegraph {
namespace plane3_test {

TEST(Plane3, HasTheNormalAndDistanceItWasMadeOf) {
  const Plane3 plane({0, 3, 4}, 1.65);
  EXPECT_LT((plane.normal() - Eigen::Vector3d(0, 0.6, 0.8)).norm(), 1e-14);
  EXPECT_NEAR(plane.distance(), 1.65, 1e-14);
  EXPECT_NEAR(plane.distance_to({7, 3, 4}), 5 - 1.65, 1e-13);
}

TEST(Plane3, IsTheSameWithNormalAndDistanceNegated) {
  EXPECT_LT(Plane3({0, 3, 4}, 2).minus(Plane3({0, -3, -4}, -2)).norm(), 1e-14);
}

TEST(Plane3, GoesIntoAnotherFrameAsItsPointsDo) {
  const SE3 T_a_b(SO3::exp({0.3, -0.2, 0.5}), Eigen::Vector3d(1, 2, -3));
  const Plane3 plane_a({1, 2, 2}, 3);
  const Plane3 plane_b = transform_to(T_a_b, plane_a);
  for (const Eigen::Vector3d& p_a : {Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(-4, 0, 1)})
    EXPECT_NEAR(std::abs(plane_b.distance_to(T_a_b.inverse() * p_a)),
                std::abs(plane_a.distance_to(p_a)), 1e-13);
}

TEST(Plane3, HasTheDerivativesOfFiniteDifferences) {
  const Plane3 plane({1, -2, 0.5}, 1.7);
  const Eigen::Vector3d p(0.3, 2, -1);
  Eigen::Matrix3d J_normal;
  Eigen::RowVector3d J_distance, J_point;
  plane.normal(&J_normal);
  plane.distance(&J_distance);
  plane.distance_to(p, &J_point);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d step = Eigen::Vector3d::Unit(k) * 1e-6;
    const Plane3 a = plane.plus(step), b = plane.plus(-step);
    EXPECT_LT(((a.normal() - b.normal()) / 2e-6 - J_normal.col(k)).norm(), 1e-9);
    EXPECT_NEAR((a.distance() - b.distance()) / 2e-6, J_distance[k], 1e-8);
    EXPECT_NEAR((a.distance_to(p) - b.distance_to(p)) / 2e-6, J_point[k], 1e-8);
  }
}

TEST(Plane3, InformationIsThatOfNormalAndDistance) {
  const Plane3 plane({1, -2, 0.5}, 1.7);
  const Eigen::Matrix3d covariance = plane_information(plane, 0.02, 0.1).inverse();
  Eigen::Matrix3d J_normal;
  Eigen::RowVector3d J_distance;
  const Eigen::Vector3d n = plane.normal(&J_normal);
  plane.distance(&J_distance);
  const Eigen::Vector3d across = n.unitOrthogonal();
  EXPECT_NEAR((across.transpose() * J_normal * covariance * J_normal.transpose() * across).value(),
              0.02 * 0.02, 1e-12);
  EXPECT_NEAR((J_distance * covariance * J_distance.transpose()).value(), 0.1 * 0.1, 1e-12);
}

TEST(Plane3, HasTheClosestPointItWasMadeOf) {
  const Eigen::Vector3d closest(0.3, -1.2, 0.7);
  const Plane3 plane = Plane3::from_closest_point(closest);
  EXPECT_LT((plane.closest_point() - closest).norm(), 1e-14);
  EXPECT_LT((Plane3(-plane.normal(), -plane.distance()).closest_point() - closest).norm(), 1e-14);
  EXPECT_THROW((void)Plane3::from_closest_point(Eigen::Vector3d::Zero()), ArgumentError);
  Eigen::Matrix3d J;
  plane.closest_point(&J);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d step = Eigen::Vector3d::Unit(k) * 1e-6;
    const Eigen::Vector3d difference =
        plane.plus(step).closest_point() - plane.plus(-step).closest_point();
    EXPECT_LT((difference / 2e-6 - J.col(k)).norm(), 1e-8);
  }
}

TEST(Plane3, CarriesCovariancesFromTheClosestPointToItsTangent) {
  const Plane3 plane({1, -2, 0.5}, 1.7);
  Eigen::Matrix3d root;
  root << 1, 0.2, 0, -0.3, 2, 0.1, 0.4, 0, 0.5;
  const Eigen::Matrix3d covariance = 1e-4 * root * root.transpose();
  Eigen::Matrix3d J;
  plane.closest_point(&J);
  const Eigen::Matrix3d back = J * tangent_covariance(plane, covariance) * J.transpose();
  EXPECT_LT((back - covariance).norm(), 1e-12);
  // Along the normal the closest point moves as the plane does.
  const Eigen::Vector3d n = plane.normal();
  const Eigen::Matrix3d of_plane = plane_information(plane, 0.02, 0.1).inverse();
  EXPECT_NEAR(n.dot((J * of_plane * J.transpose()) * n), 0.1 * 0.1, 1e-12);
  EXPECT_THROW((void)tangent_covariance(Plane3({1, 0, 0}, 0), covariance), ArgumentError);
}

TEST(Plane3, RefusesANormalOfZero) {
  EXPECT_THROW(Plane3({0, 0, 0}, 1), ArgumentError);
  EXPECT_THROW(Plane3({0, 0, 1}, std::nan("")), ArgumentError);
  EXPECT_THROW((void)plane_information(Plane3(), 0, 1), ArgumentError);
}

}  // namespace plane3_test
}  // namespace placegraph
