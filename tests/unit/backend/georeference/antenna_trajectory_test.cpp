#include <gtest/gtest.h>
#include <placegraph/backend/georeference/antenna_position.h>
#include <placegraph/backend/georeference/antenna_trajectory.h>

#include "tests/support/jacobian_check.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace antenna_trajectory_test {

constexpr std::int64_t kStep_ns = 100'000'000;

TEST(AntennaTrack, SeesAFixBetweenTwoNodesFromTheNearerOne) {
  PoseGraph graph;
  graph.nodes = {{NodeId(0), SE3()}, {NodeId(1), SE3(SO3::exp({0, 0, 0.4}), {10, 0, 0})}};
  const AntennaTrack track(graph, {{0, NodeId(0)}, {1'000'000'000, NodeId(1)}}, {});
  const auto interpolated = track.interpolate_fixes({250'000'000, 750'000'000, 1'100'000'000},
                                                    Eigen::Vector3d::Zero(), 1.0);
  ASSERT_TRUE(interpolated[0] && interpolated[1]);
  EXPECT_FALSE(interpolated[2]);
  EXPECT_EQ(interpolated[0]->node, 0);
  EXPECT_TRUE(interpolated[0]->t.isApprox(Eigen::Vector3d(2.5, 0, 0)));
  EXPECT_TRUE(interpolated[0]->A.isApprox(SO3::exp({0, 0, 0.1}).matrix()));
  EXPECT_TRUE(interpolated[0]->v.isApprox(Eigen::Vector3d(10, 0, 0)));
  EXPECT_EQ(interpolated[1]->node, 1);
  EXPECT_TRUE(interpolated[1]->t.isApprox(SO3::exp({0, 0, -0.4}) * Eigen::Vector3d(-2.5, 0, 0)));
  // A gap that is longer than allowed is not bridged.
  EXPECT_FALSE(track.interpolate_fixes({250'000'000}, Eigen::Vector3d::Zero(), 0.9)[0]);
}

TEST(AntennaTrack, LetsTheMotionFollowItsNodes) {
  PoseGraph graph;
  graph.nodes = {{NodeId(0), SE3()}, {NodeId(1), SE3(SO3(), {10, 0, 0})}};
  Trajectory motion;
  for (int i = 0; i <= 10; ++i)
    motion.poses.push_back({i * kStep_ns, SE3(SO3(), {1.0 * i, 0.5 * i * (10 - i), 0}).isometry()});
  const AntennaTrack track(graph, {{0, NodeId(0)}, {10 * kStep_ns, NodeId(1)}}, motion);
  PoseGraph moved = graph;
  moved.nodes[1].T_world_node = SE3(SO3(), {10, 2, 0});
  const Trajectory out = track.moved(moved);
  EXPECT_TRUE(out.poses[0].T_world_body->translation().isZero(1e-12));
  // Half way: half of the shift of 2 m, on top of the motion's own 12.5 m.
  EXPECT_TRUE(out.poses[5].T_world_body->translation().isApprox(Eigen::Vector3d(5, 13.5, 0)));
  EXPECT_TRUE(out.poses[10].T_world_body->translation().isApprox(Eigen::Vector3d(10, 2, 0)));
}

template <class Group>
class AntennaPosition : public testing::Test {};
using Groups = testing::Types<SE2, SE3, Sim3>;
TYPED_TEST_SUITE(AntennaPosition, Groups);

TYPED_TEST(AntennaPosition, JacobiansMatchFiniteDifferences) {
  Random random = test::seeded_random(3);
  const auto vector = [&](int n) {
    Eigen::VectorXd v(n);
    for (double& x : v) x = random.normal();
    return v;
  };
  InterpolatedFix fix;
  fix.A = SO3::exp(vector(3)).matrix();
  fix.t = vector(3);
  fix.v = vector(3);
  const Eigen::Matrix3d W = vector(3).cwiseAbs().asDiagonal();
  const AntennaPositionFactor<TypeParam> factor(fix, vector(3), W);
  const VariableManifold<TypeParam> manifold;
  const TypeParam T = TypeParam::exp(typename TypeParam::Tangent(vector(TypeParam::kDof)));
  const Eigen::VectorXd c = vector(4);
  test::expect_jacobians_match(
      factor, {test::pose_block(T, manifold), test::Block{{c[0], c[1], c[2], c[3]}}}, 1e-8);
}

}  // namespace antenna_trajectory_test
}  // namespace placegraph
