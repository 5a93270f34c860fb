#include <gtest/gtest.h>
#include <placegraph/frontend/flow/flow_cues.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/se3.h>

#include <Eigen/LU>
#include <cmath>

namespace placegraph {
namespace flow_cues_test {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Camera kCamera{.width = 640, .height = 480, .fx = 400, .fy = 420, .cx = 320, .cy = 240};
constexpr double kPixelNoise = 0.1;

/// Flow of points of the plane normal . X = distance (first camera's axes), T_1_2 between views.
std::vector<FlowVector> plane_flow(const Vector3d& normal, double distance, const SE3& T_1_2,
                                   double noise_px = 0, std::uint64_t seed = 1) {
  Random random(seed);
  std::vector<FlowVector> flow;
  for (int v = 20; v < 480; v += 40)
    for (int u = 20; u < 640; u += 40) {
      const Vector3d ray = *kCamera.unproject({u, v});
      const double depth = distance / normal.dot(ray);
      if (depth <= 0) continue;
      const auto px = kCamera.project(T_1_2.inverse() * (depth * ray));
      if (!px) continue;
      FlowVector vector;
      vector.kind = FlowVector::Kind::kFull;
      vector.px = {u, v};
      vector.flow =
          *px - vector.px + Vector2d(random.normal(0, noise_px), random.normal(0, noise_px));
      vector.covariance = noise_px * noise_px * Eigen::Matrix2d::Identity();
      flow.push_back(vector);
    }
  return flow;
}

TEST(VentralMotion, IsExactForLongTranslationsAndAnyRotation) {
  const SE3 T_1_2(SO3::exp({0.05, -0.08, 0.2}), Vector3d(0.3, -0.2, 0.15));
  const Vector3d normal = Vector3d(0.1, -0.2, 1).normalized();
  const auto flow = derotate(kCamera, plane_flow(normal, 2.0, T_1_2), {T_1_2.rotation()});
  const VentralMotion motion = ventral_motion(flow, normal);
  ASSERT_TRUE(motion.outcome) << motion.outcome.reason;
  EXPECT_LT((motion.over_distance - T_1_2.translation() / 2.0).norm(), 1e-9);
}

TEST(VentralMotion, ErrsAsItsCovarianceSaysFromFlowAndRotation) {
  const SE3 T_1_2(SO3::exp({0.01, 0.02, -0.03}), Vector3d(0.05, 0.02, 0.01));
  const double rotation_sigma = 0.001;
  Random random(5);
  double nees = 0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    const SO3 is_within_gate =
        T_1_2.rotation() *
        SO3::exp(rotation_sigma * Vector3d(random.normal(), random.normal(), random.normal()));
    const KnownRotation known_rotation{
        is_within_gate, rotation_sigma * rotation_sigma * Eigen::Matrix3d::Identity()};
    const auto flow = derotate(
        kCamera, plane_flow(Vector3d::UnitZ(), 1.5, T_1_2, kPixelNoise, 100 + run), known_rotation);
    const VentralMotion motion = ventral_motion(flow, Vector3d::UnitZ(), known_rotation.covariance);
    ASSERT_TRUE(motion.outcome);
    const Vector3d e = motion.over_distance - T_1_2.translation() / 1.5;
    nees += e.dot(motion.covariance.inverse() * e);
  }
  EXPECT_NEAR(nees / kRuns / 3, 1, 0.25);
}

TEST(VentralMotion, IsNotLedAstrayByAFifthOfFalseVectors) {
  const SE3 T_1_2(SO3(), Vector3d(0.06, 0, 0));
  auto vectors = plane_flow(Vector3d::UnitZ(), 1, T_1_2, kPixelNoise);
  for (std::size_t i = 0; i < vectors.size(); i += 5) vectors[i].flow += Vector2d(30, -20);
  const VentralMotion motion = ventral_motion(derotate(kCamera, vectors, {}), Vector3d::UnitZ());
  ASSERT_TRUE(motion.outcome);
  EXPECT_LT((motion.over_distance - Vector3d(0.06, 0, 0)).norm(), 1e-3);
  EXPECT_LE(motion.inliers, static_cast<int>(vectors.size()) * 4 / 5);
}

TEST(VentralMotion, RefusesWhatSaysTooLittle) {
  auto flow = derotate(kCamera, plane_flow(Vector3d::UnitZ(), 1, {}), {});
  EXPECT_EQ(ventral_motion(flow, Vector3d(0, 0, 2)).outcome.code, Outcome::Code::kInconsistent);
  EXPECT_EQ(ventral_motion(flow, -Vector3d::UnitZ()).outcome.code, Outcome::Code::kTooFewData);
  flow.resize(5);
  EXPECT_EQ(ventral_motion(flow, Vector3d::UnitZ()).outcome.code, Outcome::Code::kTooFewData);
  EXPECT_EQ(affine_flow(flow).outcome.code, Outcome::Code::kTooFewData);
  EXPECT_EQ(lateral_balance(flow).outcome.code, Outcome::Code::kTooFewData);
  const std::vector<DerotatedFlow> one_point(10, flow[0]);
  EXPECT_EQ(ventral_motion(one_point, Vector3d::UnitZ()).outcome.code, Outcome::Code::kDegenerate);
}

TEST(TimeToContact, IsTheTimeFromTheSecondImageOn) {
  const SE3 T_1_2(SO3::exp({0, 0.01, 0}), Vector3d(0, 0, 0.2));  // 2 m/s at 10 Hz, 3 m away
  const auto flow =
      derotate(kCamera, plane_flow(Vector3d::UnitZ(), 3, T_1_2, kPixelNoise), {T_1_2.rotation()});
  const VentralMotion motion = ventral_motion(flow, Vector3d::UnitZ());
  const TimeToContact contact = time_to_contact(motion, Vector3d::UnitZ(), 0.1);
  ASSERT_TRUE(contact.outcome);
  EXPECT_NEAR(contact.seconds, 2.8 / 2, 0.02);
  EXPECT_NEAR(contact.seconds, 1.4, 4 * contact.sigma);
  EXPECT_EQ(time_to_contact(motion, -Vector3d::UnitZ(), 0.1).outcome.code,
            Outcome::Code::kInconsistent);
}

TEST(AffineFlow, DivergesWithTheShareOfTheDistanceLeftBehind) {
  const SE3 T_1_2(SO3(), Vector3d(0, 0, 0.1));
  const AffineFlow flow =
      affine_flow(derotate(kCamera, plane_flow(Vector3d::UnitZ(), 2, T_1_2), {}));
  ASSERT_TRUE(flow.outcome);
  EXPECT_NEAR(flow.divergence(), 2 * (2 / 1.9 - 1), 1e-9);
  EXPECT_LT(flow.centre.norm(), 1e-9);
}

/// Flow beside a plane whose believed turn errs as `rotation_sigma` says.
std::vector<DerotatedFlow> misturned(const SE3& T_1_2, double rotation_sigma, int run,
                                     Random& random) {
  const SO3 is_within_gate =
      T_1_2.rotation() *
      SO3::exp(rotation_sigma * Vector3d(random.normal(), random.normal(), random.normal()));
  return derotate(kCamera, plane_flow(Vector3d::UnitZ(), 1.5, T_1_2, kPixelNoise, 100 + run),
                  {is_within_gate});
}

TEST(AffineFlow, ErrsAsItsCovarianceSaysFromFlowAndRotation) {
  // Small enough that the second order, which it leaves out, does not count.
  const SE3 T_1_2(SO3::exp({0.01, 0.02, -0.03}), Vector3d(0.02, 0.01, 0.002));
  const double rotation_sigma = 1e-3;
  const Eigen::Matrix3d rotation_covariance =
      rotation_sigma * rotation_sigma * Eigen::Matrix3d::Identity();
  const AffineFlow exact =
      affine_flow(derotate(kCamera, plane_flow(Vector3d::UnitZ(), 1.5, T_1_2), {T_1_2.rotation()}));
  Random random(6);
  double divergence2 = 0, centre2 = 0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    const AffineFlow flow =
        affine_flow(misturned(T_1_2, rotation_sigma, run, random), rotation_covariance);
    ASSERT_TRUE(flow.outcome);
    const double error = flow.divergence() - exact.divergence();
    divergence2 += error * error / flow.divergence_variance();
    const Vector2d off = flow.centre - exact.centre;
    centre2 += off.x() * off.x() / flow.covariance(0, 0);
  }
  // Means of 200 chi^2 of one degree: deviation 0.1.
  EXPECT_NEAR(divergence2 / kRuns, 1, 0.4);
  EXPECT_NEAR(centre2 / kRuns, 1, 0.4);
}

TEST(LateralBalance, ErrsAsItsSigmaSaysFromFlowAndRotation) {
  const SE3 T_1_2(SO3(), Vector3d(0.1, 0.02, 0));
  const double rotation_sigma = 1e-3;
  const Eigen::Matrix3d rotation_covariance =
      rotation_sigma * rotation_sigma * Eigen::Matrix3d::Identity();
  const LateralBalance exact =
      lateral_balance(derotate(kCamera, plane_flow(Vector3d::UnitZ(), 1.5, T_1_2), {}));
  Random random(7);
  double sum2 = 0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    const LateralBalance balance =
        lateral_balance(misturned(T_1_2, rotation_sigma, run, random), rotation_covariance);
    ASSERT_TRUE(balance.outcome);
    const double error = balance.balance - exact.balance;
    sum2 += error * error / (balance.sigma * balance.sigma);
  }
  EXPECT_NEAR(sum2 / kRuns, 1, 0.4);
}

TEST(LateralBalance, TellsWhichWallIsNearer) {
  // Walls at 1 m on the left and 2 m on the right, passed at equal pace.
  std::vector<FlowVector> vectors;
  for (const auto& [normal, distance] :
       {std::pair{Vector3d(-1, 0, 0), 1.0}, std::pair{Vector3d(1, 0, 0), 2.0}}) {
    for (const FlowVector& v : plane_flow(normal, distance, SE3(SO3(), Vector3d(0, 0, 0.1)), 0.05))
      if (normal.dot(*kCamera.unproject(v.px)) > 0.3) vectors.push_back(v);
  }
  const LateralBalance balance = lateral_balance(derotate(kCamera, vectors, {}));
  ASSERT_TRUE(balance.outcome);
  EXPECT_LT(balance.balance, -0.2);
  EXPECT_GT(balance.left, 1.8 * balance.right);
  EXPECT_GT(balance.sigma, 0);
}

}  // namespace flow_cues_test
}  // namespace placegraph
