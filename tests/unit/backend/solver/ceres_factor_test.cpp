#include <gtest/gtest.h>
#include <placegraph/backend/factors/distance.h>
#include <placegraph/backend/factors/height_above_plane.h>
#include <placegraph/backend/solver/ceres_factor.h>
#include <placegraph/graph/core/error.h>

#include <limits>

#include "tests/support/jacobian_check.h"

namespace placegraph {
namespace ceres_factor_test {

TEST(DynamicCeresFactor, IsTheFactorAsOneWhoseTypeIsKnown) {
  const SE3 T_map_cam(SO3::exp({0.1, 0.5, 0.3}), Eigen::Vector3d(1, 2, 3));
  const Plane3 plane({0.2, 1, 0.1}, 0.4);
  const HeightAbovePlaneFactor factor(1.5, 0.1);
  const DynamicCeresFactor cost(factor, {SE3(), Plane3()});
  const CeresFactor<HeightAbovePlaneFactor> known(factor);
  EXPECT_EQ(cost.num_residuals(), 1);
  EXPECT_EQ(cost.parameter_block_sizes(), known.parameter_block_sizes());
  double pose[7], block[4], J_pose[7], J_plane[4], K_pose[7], K_plane[4];
  VariableBlock<SE3>::store(T_map_cam, pose);
  VariableBlock<Plane3>::store(plane, block);
  std::vector<double*> J{J_pose, J_plane}, K{K_pose, K_plane};
  EXPECT_EQ(test::evaluate(cost, {{pose, pose + 7}, {block, block + 4}}, &J),
            test::evaluate(known, {{pose, pose + 7}, {block, block + 4}}, &K));
  for (int i = 0; i < 7; ++i) EXPECT_EQ(J_pose[i], K_pose[i]);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(J_plane[i], K_plane[i]);
  J[0] = nullptr;
  K_plane[0] = J_plane[0] = 0;
  (void)test::evaluate(cost, {{pose, pose + 7}, {block, block + 4}}, &J);
  (void)test::evaluate(known, {{pose, pose + 7}, {block, block + 4}}, &K);
  EXPECT_EQ(J_plane[0], K_plane[0]) << "a block that is held has no derivative";
}

TEST(DynamicCeresFactor, FailsWhereTheResidualIsNotANumber) {
  const DistanceFactor factor(std::numeric_limits<double>::quiet_NaN(), 0.1);
  const DynamicCeresFactor cost(factor, {SE3(), SE3()});
  double a[7], b[7], r[1];
  VariableBlock<SE3>::store(SE3(), a);
  VariableBlock<SE3>::store(SE3(SO3(), Eigen::Vector3d(1, 0, 0)), b);
  double const* const blocks[] = {a, b};
  EXPECT_FALSE(cost.Evaluate(blocks, r, nullptr));
}

TEST(Variable, DiffersFromOneOfItsOwnKindOnly) {
  const SE3 T(SO3::exp({0.1, 0.2, 0.3}), Eigen::Vector3d(1, 2, 3));
  const Vector6d xi = Vector6d::Constant(0.1);
  EXPECT_LT((minus(Variable(T.plus(xi)), Variable(T)) - xi).norm(), 1e-12);
  EXPECT_THROW((void)minus(Variable(T), Variable(SO3())), ArgumentError);
  double block[7];
  store_block(Variable(T), block);
  Variable loaded = SE3();
  load_block(block, loaded);
  EXPECT_EQ(block_size(loaded), 7);
  EXPECT_LT(minus(loaded, Variable(T)).norm(), 1e-12);
}

}  // namespace ceres_factor_test
}  // namespace placegraph
