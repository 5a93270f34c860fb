#include <gtest/gtest.h>
#include <placegraph/pipeline/flight/floor_flow.h>

#include "tests/support/seed.h"

namespace placegraph {
namespace floor_flow_test {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Camera kCamera{.width = 640, .height = 480, .fx = 400, .fy = 410, .cx = 315, .cy = 242};
const SE3 kBodyCam(SO3::exp({3.0, 0.1, -0.2}), Vector3d(0.05, -0.03, -0.02));

Vector3d random_vector(Random& random, double sigma) {
  const double x = random.normal(0, sigma), y = random.normal(0, sigma);
  return {x, y, random.normal(0, sigma)};
}

BodyState body(const SE3& T_world_body) {
  BodyState state;
  state.T_world_body = T_world_body;
  return state;
}

/// Exact flow of the floor z = `floor_z_m`.
std::vector<FlowVector> flow_between(const SE3& T_world_a, const SE3& T_world_b, double floor_z_m) {
  std::vector<FlowVector> flow;
  const SE3 T_world_1 = T_world_a * kBodyCam, T_2_world = (T_world_b * kBodyCam).inverse();
  for (double u = 40; u < 640; u += 80)
    for (double v = 40; v < 480; v += 80) {
      FlowVector vector;
      vector.kind = FlowVector::Kind::kFull;
      vector.px = {u, v};
      const Vector3d ray = T_world_1.rotation() * *kCamera.unproject(vector.px);
      const double depth = (floor_z_m - T_world_1.translation().z()) / ray.z();
      const auto px = kCamera.project(T_2_world * Vector3d(T_world_1.translation() + depth * ray));
      if (!(depth > 0) || !px) continue;
      vector.flow = *px - vector.px;
      vector.covariance = 0.01 * Eigen::Matrix2d::Identity();
      flow.push_back(vector);
    }
  return flow;
}

/// A motion over the floor, measured.
struct Motion {
  double floor_z_m;
  SE3 a, b;

  explicit Motion(Random& random)
      : floor_z_m(random.uniform(-2, 2)),
        a(SO3::exp({0, 0, random.uniform(-3, 3)}) * SO3::exp(random_vector(random, 0.1)),
          Vector3d(random.uniform(-5, 5), random.uniform(-5, 5),
                   floor_z_m + random.uniform(0.5, 3))),
        b(a * SE3(SO3::exp(random_vector(random, 0.03)), random_vector(random, 0.05))) {}

  SE3 T_1_2() const { return (a * kBodyCam).inverse() * (b * kBodyCam); }
  double height_m() const { return (a * kBodyCam).translation().z() - floor_z_m; }
  Vector3d measured(const std::vector<FlowVector>& flow, const SE3& T_world_a) const {
    const FloorFlow floor({}, kCamera, kBodyCam, floor_z_m);
    const auto found = floor.measure(flow, body(T_world_a), 50'000'000,
                                     {T_1_2().rotation(), Eigen::Matrix3d::Zero()});
    EXPECT_TRUE(found.observation) << found.outcome.reason;
    return found.observation ? found.observation->over_distance : Vector3d(Vector3d::Zero());
  }
};

TEST(FloorFlowLaw, FlowTimesHeightIsTheCamerasTranslation) {
  Random random = test::seeded_random(21);
  for (int trial = 0; trial < 50; ++trial) {
    const Motion motion(random);
    const Vector3d over_distance =
        motion.measured(flow_between(motion.a, motion.b, motion.floor_z_m), motion.a);
    EXPECT_LT((motion.height_m() * over_distance - motion.T_1_2().translation()).norm(), 1e-6);
  }
}

/// The camera sees the same, whichever way the world's axes x and y point and wherever they begin.
TEST(FloorFlowLaw, RotatingTheWorldAboutTheVerticalChangesNothing) {
  Random random = test::seeded_random(22);
  for (int trial = 0; trial < 50; ++trial) {
    const Motion motion(random);
    const auto flow = flow_between(motion.a, motion.b, motion.floor_z_m);
    const SE3 T_other_world(SO3::exp({0, 0, random.uniform(-3, 3)}),
                            Vector3d(random.normal(0, 10), random.normal(0, 10), 0));
    const Vector3d here = motion.measured(flow, motion.a),
                   there = motion.measured(flow, T_other_world * motion.a);
    EXPECT_LT((here - there).norm(), 1e-9);
  }
}

}  // namespace floor_flow_test
}  // namespace placegraph
