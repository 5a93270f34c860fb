#include <gtest/gtest.h>
#include <placegraph/backend/factors/absolute_rotation.h>
#include <placegraph/backend/factors/bearing.h>
#include <placegraph/backend/factors/height_above_plane.h>
#include <placegraph/backend/factors/line_reprojection.h>
#include <placegraph/backend/factors/marker_corners.h>
#include <placegraph/backend/factors/non_holonomic.h>
#include <placegraph/backend/factors/plane_observation.h>
#include <placegraph/backend/factors/plane_orthogonal.h>
#include <placegraph/backend/factors/plane_parallel.h>
#include <placegraph/backend/factors/point_observation.h>
#include <placegraph/backend/factors/point_on_plane.h>
#include <placegraph/backend/factors/pose_prior.h>
#include <placegraph/backend/factors/radial_reprojection.h>

#include "tests/support/factor_check.h"
#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace graph_factors_test {

using test::evaluate;
using test::expect_jacobians_match;

const SE3 kT_world_a(SO3::exp({0.3, -0.5, 0.2}), Eigen::Vector3d(1, -2, 0.5));
const SE3 kT_world_b(SO3::exp({-0.1, 0.4, 0.3}), Eigen::Vector3d(2, 1, 1.5));

Eigen::Matrix3d some_whitening() {
  Eigen::Matrix3d W;
  W << 2, 1, 0, 0, 1, -1, 0.5, 0, 3;
  return W;
}

TEST(PosePriorFactor, IsTheErrorPoseAndHasTheJacobiansOfFiniteDifferences) {
  const PosePriorFactor<SE3> factor(kT_world_a, 2 * Matrix6d::Identity());
  const Eigen::VectorXd r = evaluate(factor, {kT_world_b});
  EXPECT_LT((r - 2 * (kT_world_a.inverse() * kT_world_b).log()).norm(), 1e-12);
  expect_jacobians_match(factor, {kT_world_b});
  expect_jacobians_match(PosePriorFactor<SE2>(SE2(1, 2, 3), Eigen::Matrix3d(some_whitening())),
                         {SE2(0.5, 1, 2)});
  expect_jacobians_match(
      PosePriorFactor<Sim3>(Sim3(SO3(), {1, 2, 3}, 2), Sim3::Jacobian(Sim3::Jacobian::Identity()),
                            RotationError::kQuaternion),
      {Sim3(SO3::exp({0.1, 0.5, 0}), {1, 0, 3}, 1.3)});
}

TEST(AbsoluteRotationFactor, IsZeroWhereTheFramesAgree) {
  const SO3 R_world_manhattan = SO3::exp({0, 0.7, 0});
  const SO3 R_cam_manhattan = kT_world_a.rotation().inverse() * R_world_manhattan;
  const AbsoluteRotationFactor factor(R_cam_manhattan, some_whitening());
  EXPECT_LT(evaluate(factor, {kT_world_a, R_world_manhattan}).norm(), 1e-14);
}

TEST(AbsoluteRotationFactor, HasTheJacobiansOfFiniteDifferences) {
  const AbsoluteRotationFactor factor(SO3::exp({0.2, 0.8, -0.4}), some_whitening());
  expect_jacobians_match(factor, {kT_world_a, SO3::exp({0, 0.7, 0.1})});
  expect_jacobians_match(factor, {kT_world_a, SO3::exp({1, -1, 0.5})});
}

TEST(PointObservationFactor, IsTheMeasurementAndHasTheJacobiansOfFiniteDifferences) {
  const Camera camera = test::window_camera();
  const Eigen::Vector3d p_cam(1.5, -0.4, 7);
  const PointObservationFactor<Reprojection> reprojection(Reprojection(camera, {700, 100}, 0.5));
  const Eigen::VectorXd r = evaluate(reprojection, {kT_world_a, kT_world_a * p_cam});
  EXPECT_LT((r - (*camera.project(p_cam) - Eigen::Vector2d(700, 100)) / 0.5).norm(), 1e-9);
  expect_jacobians_match(reprojection, {kT_world_a, kT_world_a * p_cam}, 1e-7);
  expect_jacobians_match(PointObservationFactor<InverseDepth>(InverseDepth(0.1, 0.01)),
                         {kT_world_a, kT_world_a * p_cam});
}

TEST(PointObservationFactor, OfAPointBehindTheCameraIsDearAndPullsNowhere) {
  const PointObservationFactor<Reprojection> factor(
      Reprojection(test::window_camera(), {700, 100}, 0.5));
  std::vector<Eigen::MatrixXd> J;
  const Eigen::VectorXd r =
      evaluate(factor, {kT_world_a, kT_world_a * Eigen::Vector3d(1, 1, -3)}, &J);
  EXPECT_EQ(r, Eigen::Vector2d(kUnprojectableResidual, 0));
  EXPECT_TRUE(J[0].isZero(0));
  EXPECT_TRUE(J[1].isZero(0));
}

TEST(LineReprojectionFactor, IsTheDistanceOfTheEndsFromTheProjectedLine) {
  const Camera camera = test::window_camera();
  const Eigen::Vector3d a_cam(-1, 0.5, 6), b_cam(2, -0.3, 9);
  const Eigen::Vector2d a_px = *camera.project(a_cam), b_px = *camera.project(b_cam);
  const Eigen::Vector2d along = (b_px - a_px).normalized();
  const Eigen::Vector2d across(-along[1], along[0]);
  // The ends moved along the line change nothing, moved across they count by their distance.
  const LineReprojectionFactor factor(camera, a_px + 30 * along + 2 * across,
                                      b_px - 11 * along - 3 * across, 0.5);
  const Line3 line = Line3::from_direction(kT_world_a * a_cam,
                                           kT_world_a.rotation() * Eigen::Vector3d(b_cam - a_cam));
  const Eigen::VectorXd r = evaluate(factor, {kT_world_a, line});
  EXPECT_NEAR(std::abs(r[0]), 4, 1e-9);
  EXPECT_NEAR(std::abs(r[1]), 6, 1e-9);
  EXPECT_LT(r[0] * r[1], 0);
}

TEST(LineReprojectionFactor, HasTheJacobiansOfFiniteDifferences) {
  const LineReprojectionFactor factor(test::window_camera(), {500, 100}, {800, 200}, 0.7);
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(1, 0.2, 0.1), Eigen::Vector3d(0.1, -2, 0.5), Eigen::Vector3d(0.1, 0, 1)})
    expect_jacobians_match(
        factor,
        {kT_world_a, Line3::from_direction(kT_world_a * Eigen::Vector3d(1, -0.5, 8), direction)},
        1e-6);
}

TEST(LineReprojectionFactor, OfASecondCameraIsThatOfACameraThere) {
  const Eigen::Vector3d second_in_cam(0.4, -0.1, 0);
  const Line3 line = Line3::from_direction(kT_world_a * Eigen::Vector3d(1, -0.5, 8), {1, 0.7, 0.3});
  const LineReprojectionFactor beside(test::window_camera(), {500, 100}, {800, 200}, 0.7,
                                      second_in_cam);
  const LineReprojectionFactor there(test::window_camera(), {500, 100}, {800, 200}, 0.7);
  LineReprojectionFactor::Residual r, expected;
  beside.compute(kT_world_a, line, r, nullptr);
  there.compute(kT_world_a * SE3(SO3(), second_in_cam), line, expected, nullptr);
  EXPECT_LT((r - expected).norm(), 1e-9);
  expect_jacobians_match(beside, {kT_world_a, line}, 1e-6);
}

TEST(LineReprojectionFactor, OfALineWithoutImageIsDearAndPullsNowhere) {
  const LineReprojectionFactor factor(test::window_camera(), {500, 100}, {800, 200}, 0.7);
  std::vector<Eigen::MatrixXd> J;
  const Eigen::VectorXd r =
      evaluate(factor, {SE3(), Line3::from_direction({1, 0, 0}, {0, 1, 0})}, &J);
  EXPECT_EQ(r, Eigen::Vector2d(kUnprojectableResidual, 0));
  EXPECT_TRUE(J[0].isZero(0));
  EXPECT_TRUE(J[1].isZero(0));
}

TEST(PlaneObservationFactor, IsZeroForThePlaneItSeesWithEitherSign) {
  const Plane3 plane_world({1, 2, 2}, 3);
  const Plane3 plane_a = transform_to(kT_world_a, plane_world);
  for (const double sign : {1.0, -1.0}) {
    const PlaneObservationFactor factor(Plane3(sign * plane_a.normal(), sign * plane_a.distance()),
                                        some_whitening());
    EXPECT_LT(evaluate(factor, {kT_world_a, plane_world}).norm(), 1e-13);
  }
}

TEST(PlaneObservationFactor, HasTheJacobiansOfFiniteDifferences) {
  const PlaneObservationFactor factor(Plane3({0.2, -1, 0.3}, 1.65), some_whitening());
  expect_jacobians_match(factor, {kT_world_a, Plane3({0.1, -1, 0.5}, 2)});
  expect_jacobians_match(factor, {kT_world_a, Plane3({-0.7, -1, 0.5}, -20)});
}

TEST(PlaneRelations, ParallelIsTheSineAndOrthogonalTheCosineOfTheAngle) {
  const double angle_rad = 0.3;
  const Plane3 a({0, 0, 1}, 2), b({std::sin(angle_rad), 0, std::cos(angle_rad)}, -5);
  EXPECT_NEAR(evaluate(PlaneParallelFactor(0.1), {a, b}).norm(), std::sin(angle_rad) / 0.1, 1e-12);
  EXPECT_NEAR(std::abs(evaluate(PlaneOrthogonalFactor(0.1), {a, b})[0]), std::cos(angle_rad) / 0.1,
              1e-12);
}

TEST(PlaneRelations, HaveTheJacobiansOfFiniteDifferences) {
  const Plane3 a({0.3, -1, 2}, 2), b({1, 0.4, 0.2}, -5);
  expect_jacobians_match(PlaneParallelFactor(0.1), {a, b});
  expect_jacobians_match(PlaneOrthogonalFactor(0.1), {a, b});
  const Plane3 same = a;
  expect_jacobians_match(PlaneParallelFactor(0.1), {a, same});
}

TEST(PointOnPlaneFactor, IsTheDistanceAndHasTheJacobiansOfFiniteDifferences) {
  const PointOnPlaneFactor factor(0.5);
  EXPECT_NEAR(evaluate(factor, {Eigen::Vector3d(3, 1, 4), Plane3({0, 0, 1}, 2)})[0], 4, 1e-12);
  expect_jacobians_match(factor, {Eigen::Vector3d(3, 1, 4), Plane3({0.3, -1, 2}, 2)});
}

TEST(HeightAbovePlaneFactor, CountsTheHeightOnEitherSide) {
  const HeightAbovePlaneFactor factor(1.65, 0.1);
  const SE3 T_world_cam(SO3::exp({0.1, 0.2, 0.3}), Eigen::Vector3d(5, 6, 1.75));
  for (const double sign : {1.0, -1.0}) {
    const Plane3 ground({0, 0, sign}, 0);
    EXPECT_NEAR(evaluate(factor, {T_world_cam, ground})[0], 1, 1e-12);
    expect_jacobians_match(factor, {T_world_cam, ground});
    expect_jacobians_match(factor, {T_world_cam, Plane3({0.1, -0.2, sign}, 0.3)});
  }
}

TEST(MarkerCornersFactor, IsTheReprojectionOfTheFourCorners) {
  const Camera camera = test::window_camera();
  // Facing the camera, upright: x right, y up, z towards it.
  const Marker marker{
      SE3(Eigen::Matrix3d(Eigen::Vector3d(1, -1, -1).asDiagonal()), Eigen::Vector3d(0, 0, 4)), 0.4};
  MarkerCornersFactor::Corners corners;
  const double h = 0.2;
  corners[0] = *camera.project({-h, -h, 4});
  corners[1] = *camera.project({h, -h, 4});
  corners[2] = *camera.project({h, h, 4});
  corners[3] = *camera.project({-h, h, 4});
  EXPECT_LT(evaluate(MarkerCornersFactor(camera, corners, 0.5), {SE3(), marker}).norm(), 1e-10);
}

TEST(MarkerCornersFactor, HasTheJacobiansOfFiniteDifferences) {
  const MarkerCornersFactor factor(
      test::window_camera(), {Eigen::Vector2d(500, 100), {600, 110}, {590, 210}, {510, 190}}, 0.7);
  const Marker marker{kT_world_a * SE3(SO3::exp({2.8, 0.3, 0.2}), Eigen::Vector3d(0.3, -0.2, 3)),
                      0.5};
  expect_jacobians_match(factor, {kT_world_a, marker}, 1e-6);
}

TEST(MarkerCornersFactor, OfAMarkerBehindTheCameraPullsNowhere) {
  MarkerCornersFactor::Corners corners;
  corners.fill({600, 180});
  const MarkerCornersFactor factor(test::window_camera(), corners, 1);
  std::vector<Eigen::MatrixXd> J;
  const Eigen::VectorXd r =
      evaluate(factor, {SE3(), Marker{SE3(SO3(), Eigen::Vector3d(0, 0, -4)), 0.4}}, &J);
  EXPECT_EQ(r[6], kUnprojectableResidual);
  EXPECT_TRUE(J[0].isZero(0));
  EXPECT_TRUE(J[1].isZero(0));
}

TEST(BearingFactor, IsTheChordBetweenTheDirectionsWhateverTheDistance) {
  const BearingFactor factor({0, 0, 2}, 10 * Eigen::Matrix3d::Identity());
  for (const double distance_m : {0.1, 50.0}) {
    const SE3 ahead(SO3(), Eigen::Vector3d(0, 0, distance_m));
    const SE3 right(SO3(), Eigen::Vector3d(distance_m, 0, 0));
    EXPECT_LT(evaluate(factor, {kT_world_a, kT_world_a * ahead}).norm(), 1e-12);
    EXPECT_NEAR(evaluate(factor, {kT_world_a, kT_world_a * right}).norm(), 10 * std::sqrt(2),
                1e-12);
    EXPECT_NEAR(evaluate(factor, {kT_world_a, kT_world_a * ahead.inverse()}).norm(), 20, 1e-12);
  }
}

TEST(BearingFactor, HasTheJacobiansOfFiniteDifferencesAndNoneForCoincidentCameras) {
  const BearingFactor factor({0.3, -0.2, 1}, some_whitening());
  expect_jacobians_match(factor, {kT_world_a, kT_world_b});
  std::vector<Eigen::MatrixXd> J;
  EXPECT_TRUE(evaluate(factor, {kT_world_a, kT_world_a}, &J).allFinite());
  EXPECT_TRUE(J[0].isZero(0));
}

TEST(NonHolonomicFactor, IsZeroOnAnArcOfTheRearAxle) {
  // The camera sits 1.5 m before and 0.3 m left of the axle: x right, z forward.
  const SE3 T_axle_cam(SO3(), Eigen::Vector3d(-0.3, -1, 1.5));
  const Eigen::Vector3d axle_cam = -T_axle_cam.translation();
  const NonHolonomicFactor factor(Eigen::Vector3d::UnitX(), axle_cam, 0.02);
  const double rotation_rad = 0.4, radius_m = 8;
  const SE3 step(SO3::exp({0, rotation_rad, 0}),
                 Eigen::Vector3d(radius_m * (1 - std::cos(rotation_rad)), 0,
                                 radius_m * std::sin(rotation_rad)));
  const SE3 T_cam_next = T_axle_cam.inverse() * step * T_axle_cam;
  EXPECT_NEAR(evaluate(factor, {kT_world_a, kT_world_a * T_cam_next})[0], 0, 1e-12);
  // Slipping 4 cm sideways in a straight step counts as two sigmas.
  EXPECT_NEAR(
      evaluate(factor, {kT_world_a, kT_world_a * SE3(SO3(), Eigen::Vector3d(0.04, 0, 1))})[0], 2,
      1e-12);
}

TEST(NonHolonomicFactor, HasTheJacobiansOfFiniteDifferences) {
  expect_jacobians_match(NonHolonomicFactor({1, 0.1, 0}, {0.3, 1, -1.5}, 0.1),
                         {kT_world_a, kT_world_b});
}

TEST(RadialReprojectionFactor, IsTheDistortedProjection) {
  const RadialReprojectionFactor factor({100, -50}, 0.5);
  const Eigen::Vector3d p_cam(0.4, 0.2, 2), intrinsics(500, -0.1, 0.02);
  const double s = 0.05, d = 1 - 0.1 * s + 0.02 * s * s;
  const Eigen::VectorXd r = evaluate(factor, {kT_world_a, intrinsics, kT_world_a * p_cam});
  EXPECT_LT((r - Eigen::Vector2d(500 * d * 0.2 - 100, 500 * d * 0.1 + 50) / 0.5).norm(), 1e-10);
}

TEST(RadialReprojectionFactor, HasTheJacobiansOfFiniteDifferences) {
  const RadialReprojectionFactor factor({100, -50}, 0.5);
  for (const double z : {2.0, 20.0, -5.0})
    expect_jacobians_match(
        factor,
        {kT_world_a, Eigen::Vector3d(500, -0.1, 0.02), kT_world_a * Eigen::Vector3d(0.4, 0.2, z)},
        1e-7);
}

TEST(RadialReprojectionFactor, CannotProjectAPointInThePlaneOfTheCamera) {
  const RadialReprojectionFactor factor({100, -50}, 0.5);
  RadialReprojectionFactor::Residual r;
  EXPECT_FALSE(factor.compute(SE3(), {500, 0, 0}, {1, 1, 0}, r, nullptr));
}

}  // namespace graph_factors_test
}  // namespace placegraph
