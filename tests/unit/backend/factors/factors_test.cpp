#include <gtest/gtest.h>
#include <placegraph/backend/factors/camera_reprojection.h>
#include <placegraph/backend/factors/distance.h>
#include <placegraph/backend/factors/inverse_depth.h>
#include <placegraph/backend/factors/marginal_prior.h>
#include <placegraph/backend/factors/point_in_node.h>
#include <placegraph/backend/factors/position.h>
#include <placegraph/backend/factors/relative_pose.h>
#include <placegraph/backend/factors/reprojection.h>
#include <placegraph/backend/solver/ceres_factor.h>
#include <placegraph/backend/solver/kernel_loss.h>
#include <placegraph/backend/window/point_factor.h>
#include <placegraph/graph/core/angle.h>

#include "tests/support/jacobian_check.h"
#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace factors_test {

using test::Block;
using test::pose_block;

template <class Group>
Group random_element(Random& random, double sigma, double sigma_rad) {
  typename Group::Tangent xi;
  constexpr int dim = Group::kDof == 3 ? 2 : 3;
  for (int i = 0; i < Group::kDof; ++i) xi[i] = random.normal() * (i < dim ? sigma : sigma_rad);
  if (Group::kDof == 7) xi[Group::kDof - 1] *= 0.3;
  return Group::exp(xi);
}

class PointFactors : public testing::Test {
 protected:
  VariableManifold<SE3> manifold_;
  SE3 T_map_cam_{SO3::exp({0.3, -0.5, 0.2}), Eigen::Vector3d(1, -2, 0.5)};
  std::vector<Block> blocks(const Eigen::Vector3d& p_cam) const {
    const Eigen::Vector3d p_map = T_map_cam_ * p_cam;
    return {pose_block(T_map_cam_, manifold_), Block{{p_map[0], p_map[1], p_map[2]}}};
  }
};

TEST_F(PointFactors, CameraReprojectionFollowsTheLens) {
  Camera camera = test::window_camera();
  const Eigen::Vector3d p_cam(1.5, -0.4, 7);
  const Eigen::Vector2d px(700, 100);
  for (const Distortion lens : {Distortion::kRadialTangential, Distortion::kEquidistant}) {
    camera.distortion = lens;
    camera.coefficients = {-0.2, 0.05, 0.002, -0.003, 0};
    const PointFactor<CameraReprojection> factor(CameraReprojection{camera, px, 0.5});
    const auto b = blocks(p_cam);
    const Eigen::Vector2d expected = (*camera.project(p_cam) - px) / 0.5;
    EXPECT_LT((test::evaluate(factor, {b[0].x, b[1].x}) - expected).norm(), 1e-9);
    test::expect_jacobians_match(factor, b, 1e-6);
  }
}

TEST_F(PointFactors, ReprojectionIsTheCamerasProjectionInSigmas) {
  const Camera camera = test::window_camera();
  const Eigen::Vector3d p_cam(1.5, -0.4, 7);
  const Eigen::Vector2d px(700, 100);
  const PointFactor<Reprojection> factor(Reprojection(camera, px, 0.5));
  const auto b = blocks(p_cam);
  const Eigen::Vector2d expected = (*camera.project(p_cam) - px) / 0.5;
  EXPECT_LT((test::evaluate(factor, {b[0].x, b[1].x}) - expected).norm(), 1e-9);
}

TEST_F(PointFactors, ReprojectionHasTheJacobiansOfFiniteDifferences) {
  const PointFactor<Reprojection> factor(Reprojection(test::window_camera(), {700, 100}, 0.7));
  for (const double depth_m : {2.0, 10.0, 80.0})
    test::expect_jacobians_match(factor, blocks({0.4 * depth_m, -0.2 * depth_m, depth_m}), 1e-7);
}

TEST_F(PointFactors, ReprojectionWeighsEachDirectionByItsCovariance) {
  const Camera camera = test::window_camera();
  const Eigen::Vector3d p_cam(1.5, -0.4, 7);
  const Eigen::Vector2d px(700, 100), error = *camera.project(p_cam) - px;
  Eigen::Matrix2d covariance;
  covariance << 0.5, -0.3, -0.3, 0.9;
  const PointFactor<Reprojection> factor(Reprojection(camera, px, covariance));
  const auto b = blocks(p_cam);
  EXPECT_NEAR(test::evaluate(factor, {b[0].x, b[1].x}).squaredNorm(),
              error.dot(covariance.inverse() * error), 1e-9 * error.squaredNorm());
  for (const double depth_m : {2.0, 10.0, 80.0})
    test::expect_jacobians_match(factor, blocks({0.4 * depth_m, -0.2 * depth_m, depth_m}), 1e-7);
}

TEST_F(PointFactors, InverseDepthHasTheJacobiansOfFiniteDifferences) {
  const PointFactor<InverseDepth> factor(InverseDepth(0.1, 0.01));
  const auto b = blocks({1, 2, 5});
  const Eigen::VectorXd r = test::evaluate(factor, {b[0].x, b[1].x});
  EXPECT_NEAR(r[0], (0.2 - 0.1) / 0.01, 1e-12);
  EXPECT_EQ(r[1], 0);
  for (const double depth_m : {2.0, 10.0, 80.0})
    test::expect_jacobians_match(factor, blocks({0.4 * depth_m, -0.2 * depth_m, depth_m}));
}

TEST_F(PointFactors, APointBehindTheCameraIsDearAndPullsNowhere) {
  const PointFactor<Reprojection> factor(Reprojection(test::window_camera(), {700, 100}, 0.7));
  for (const Eigen::Vector3d& p_cam :
       {Eigen::Vector3d(1, 1, -5), Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(0, 0, 1e200)}) {
    const auto b = blocks(p_cam);
    double J_pose[14], J_point[6];
    std::vector<double*> jacobians{J_pose, J_point};
    const Eigen::VectorXd r = test::evaluate(factor, {b[0].x, b[1].x}, &jacobians);
    EXPECT_EQ(r, Eigen::Vector2d(kUnprojectableResidual, 0));
    for (const double j : J_pose) EXPECT_EQ(j, 0);
    for (const double j : J_point) EXPECT_EQ(j, 0);
  }
}

TEST(DistanceFactor, HasTheJacobiansOfFiniteDifferences) {
  VariableManifold<SE3> manifold;
  const SE3 T_map_a(SO3::exp({0.1, 2, 0.3}), Eigen::Vector3d(1, 2, 3));
  const SE3 T_map_b(SO3::exp({-1, 0.2, 0.3}), Eigen::Vector3d(2, 1, 4));
  const CeresFactor<DistanceFactor> factor(DistanceFactor(1.5, 0.1));
  const std::vector<Block> blocks{pose_block(T_map_a, manifold), pose_block(T_map_b, manifold)};
  EXPECT_NEAR(test::evaluate(factor, {blocks[0].x, blocks[1].x})[0], (std::sqrt(3.0) - 1.5) / 0.1,
              1e-12);
  test::expect_jacobians_match(factor, blocks);
}

TEST(DistanceFactor, OfThePlaneIsThatOfSpaceWithoutHeightAndTilt) {
  Random random(5);
  const std::vector<int> planar = {0, 1, 5};
  for (int trial = 0; trial < 50; ++trial) {
    const SE2 T_map_a(random.normal(), random.normal(), random.uniform(-4, 4));
    const SE2 T_map_b(random.normal(), random.normal(), random.uniform(-4, 4));
    const auto in_space = [](const SE2& T) {
      return SE3(SO3::exp({0, 0, T.rotation().angle()}),
                 Eigen::Vector3d(T.translation().x(), T.translation().y(), 0.7));
    };
    DistanceFactorOf<SE2>::Residual r;
    DistanceFactorOf<SE2>::Jacobians J;
    DistanceFactor::Residual of_space;
    DistanceFactor::Jacobians J_of_space;
    EXPECT_TRUE(DistanceFactorOf<SE2>(1.5, 0.1).compute(T_map_a, T_map_b, r, &J));
    EXPECT_TRUE(DistanceFactor(1.5, 0.1).compute(in_space(T_map_a), in_space(T_map_b), of_space,
                                                 &J_of_space));
    EXPECT_NEAR(r[0], of_space[0], 1e-12);
    EXPECT_LT((std::get<0>(J) - std::get<0>(J_of_space)(Eigen::all, planar)).norm(), 1e-9);
    EXPECT_LT((std::get<1>(J) - std::get<1>(J_of_space)(Eigen::all, planar)).norm(), 1e-9);
  }
}

TEST(DistanceFactor, OfCoincidentCamerasIsFinite) {
  const SE3 T_map_a;
  DistanceFactor::Residual r;
  DistanceFactor::Jacobians J;
  EXPECT_TRUE(DistanceFactor(1, 0.5).compute(T_map_a, T_map_a, r, &J));
  EXPECT_EQ(r[0], -2);
  EXPECT_TRUE(std::get<0>(J).isZero(0));
}

TEST(MarginalPriorFactor, HasTheJacobiansOfFiniteDifferencesAlsoFarFromItsLinearizationPoint) {
  Random random(3);
  VariableManifold<SE3> manifold;
  for (const double size : {0.0, 0.01, 1.0}) {
    MarginalPrior prior;
    std::vector<Block> blocks;
    for (int k = 0; k < 3; ++k) {
      prior.keyframes.push_back(KeyframeId(k));
      prior.T_map_cam_lin.push_back(random_element<SE3>(random, 2, 1));
      blocks.push_back(pose_block(
          prior.T_map_cam_lin.back() * random_element<SE3>(random, size, size), manifold));
    }
    prior.J = Eigen::MatrixXd::Zero(11, 18);
    for (Eigen::Index i = 0; i < prior.J.size(); ++i) prior.J.data()[i] = random.normal();
    prior.e = Eigen::VectorXd::LinSpaced(11, -1, 1);
    test::expect_jacobians_match(MarginalPriorFactor(prior), blocks);
  }
}

TEST(MarginalPriorFactor, HasTheJacobiansOfFiniteDifferencesForPlanesAndWorldsToo) {
  Random random(4);
  MarginalPrior prior;
  prior.keyframes = {KeyframeId(0)};
  prior.T_map_cam_lin = {random_element<SE3>(random, 2, 1)};
  prior.planes = {PlaneId(0)};
  prior.plane_lin = {Plane3(Eigen::Vector3d(0.1, -0.9, 0.2), 1.6)};
  prior.manhattan_frames = {ManhattanFrameId(3)};
  prior.R_map_manhattan_lin = {SO3::exp({0.3, -1, 0.2})};
  prior.J = Eigen::MatrixXd::Zero(7, 12);
  for (Eigen::Index i = 0; i < prior.J.size(); ++i) prior.J.data()[i] = random.normal();
  prior.e = Eigen::VectorXd::LinSpaced(7, -1, 1);
  const VariableManifold<SE3> pose;
  const VariableManifold<Plane3> plane;
  const VariableManifold<SO3> world;
  test::expect_jacobians_match(
      MarginalPriorFactor(prior),
      {pose_block(prior.T_map_cam_lin[0] * random_element<SE3>(random, 0.1, 0.1), pose),
       pose_block(Plane3(Eigen::Vector3d(0.2, -0.8, 0.1), 1.5), plane),
       pose_block(prior.R_map_manhattan_lin[0] * SO3::exp({0.2, 0.1, -0.3}), world)});
}

TEST(KernelLoss, GivesTheKernelsValues) {
  const RobustKernel kernel{RobustKernel::Kind::kCauchy, 1.7};
  double rho[3];
  KernelLoss(kernel).Evaluate(2.5, rho);
  const RobustKernel::Value value = kernel.evaluate(2.5);
  EXPECT_EQ(rho[0], value.rho);
  EXPECT_EQ(rho[1], value.first);
  EXPECT_EQ(rho[2], value.second);
}

template <class Group>
class PoseFactors : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(PoseFactors, Groups);

TYPED_TEST(PoseFactors, TheManifoldPerturbsOnTheRightAndMinusUndoesPlus) {
  using Group = TypeParam;
  Random random(5);
  const VariableManifold<Group> manifold;
  const Group T = random_element<Group>(random, 2, 1);
  const typename Group::Tangent xi = random_element<Group>(random, 1, 0.5).log();
  const Block block = pose_block(T, manifold);
  const std::vector<double> moved = block.plus(xi);
  const Group expected = T.plus(xi);
  EXPECT_LT((VariableBlock<Group>::load(moved.data()).inverse() * expected).log().norm(), 1e-12);
  typename Group::Tangent back;
  manifold.Minus(moved.data(), block.x.data(), back.data());
  EXPECT_LT((back - xi).norm(), 1e-12);
}

TYPED_TEST(PoseFactors, RelativePoseHasTheJacobiansOfFiniteDifferencesAtAnySizeOfTheError) {
  using Group = TypeParam;
  const VariableManifold<Group> manifold;
  for (const RotationError kind : {RotationError::kLog, RotationError::kQuaternion})
    for (const double size : {0.0, 1e-6, 0.01, 1.0}) {
      Random random(7);
      for (int trial = 0; trial < 20; ++trial) {
        SCOPED_TRACE(testing::Message() << "convention " << static_cast<int>(kind) << " size "
                                        << size << " trial " << trial);
        const Group T_from_to = random_element<Group>(random, 2, 1);
        const Group T_world_from = random_element<Group>(random, 2, 1);
        const Group E = random_element<Group>(random, 3 * size, size);
        // Beyond 2.9 rad the cut of the log at pi is too near for finite differences.
        if (E.rotation().log().norm() > 2.9) continue;
        typename Group::Jacobian W = Group::Jacobian::Identity();
        for (Eigen::Index i = 0; i < W.size(); ++i) W.data()[i] += 0.3 * random.normal();
        const CeresFactor<RelativePoseFactor<Group>> factor(
            RelativePoseFactor<Group>(T_from_to, W, kind));
        test::expect_jacobians_match(factor,
                                     {pose_block(T_world_from, manifold),
                                      pose_block(T_world_from * T_from_to * E, manifold)},
                                     1e-7);
      }
    }
}

TYPED_TEST(PoseFactors, PositionHasTheJacobiansOfFiniteDifferences) {
  using Group = TypeParam;
  Random random(9);
  const VariableManifold<Group> manifold;
  Eigen::Matrix3d W;
  W << 2, 1, 0, 0, 1, -1, 0.5, 0, 3;
  const CeresFactor<PositionFactor<Group>> factor(
      PositionFactor<Group>({1, 2, 3}, {0.4, -0.3, 0.2}, W));
  test::expect_jacobians_match(factor, {pose_block(random_element<Group>(random, 2, 1), manifold)});
}

TEST(PointInNodeFactor, HasTheJacobiansOfFiniteDifferences) {
  Random random(11);
  Eigen::Matrix3d W;
  W << 2, 1, 0, 0, 1, -1, 0.5, 0, 3;
  const Block point{{3, -2, 1.5}};
  const VariableManifold<SE3> in_space;
  test::expect_jacobians_match(
      CeresFactor<PointInNodeFactor<SE3>>(PointInNodeFactor<SE3>({1, 2, 3}, W)),
      {pose_block(random_element<SE3>(random, 2, 1), in_space), point});
  const VariableManifold<SE2> in_plane;
  test::expect_jacobians_match(CeresFactor<PointInNodeFactor<SE2>>(
                                   PointInNodeFactor<SE2>({1, 2, 0}, W.topLeftCorner<2, 2>())),
                               {pose_block(random_element<SE2>(random, 2, 1), in_plane), point});
}

TEST(PoseError, InTheQuaternionConventionIsTranslationAndVectorPartWithPositiveScalar) {
  // A rotation by 200 deg is one by -160 deg: the vector part must not jump to sin(100 deg).
  const double angle_rad = deg_to_rad(200);
  const SE3 E(SO3(Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()))),
              Eigen::Vector3d(1, 2, 3));
  Vector6d expected;
  expected << 1, 2, 3, 0, 0, -std::sin(deg_to_rad(80));
  EXPECT_LT((pose_error(E, RotationError::kQuaternion) - expected).norm(), 1e-12);
}

TEST(PoseError, OfThePlaneInTheQuaternionConventionHasTheWholeAngle) {
  EXPECT_LT(
      (pose_error(SE2(1, 2, 0.3), RotationError::kQuaternion) - Eigen::Vector3d(1, 2, 0.3)).norm(),
      1e-12);
}

}  // namespace factors_test
}  // namespace placegraph
