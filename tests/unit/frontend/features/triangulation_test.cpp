#include <gtest/gtest.h>
#include <placegraph/frontend/features/triangulation.h>

#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace triangulation_test {

using namespace test;
using Code = Outcome::Code;
const Camera kCamera = pinhole(640, 480, 500);
const SE3 kSecond = pose({0, -0.05, 0}, {1, 0, 0}), kThird = pose({0, -0.1, 0.1}, {1.5, 0.4, 0.3});

std::vector<PointMeasurement> observations_of(const Eigen::Vector3d& point_ref,
                                              const std::vector<SE3>& T_ref_cam) {
  std::vector<PointMeasurement> observations;
  for (const SE3& T : T_ref_cam)
    observations.push_back({T, *kCamera.project(T.inverse() * point_ref)});
  return observations;
}

TEST(Triangulation, IsExactWithoutNoise) {
  Random random = seeded_random(41);
  const PointScene scene = make_scene(kCamera, {SE3(), kSecond, kThird}, 30, random);
  for (const Eigen::Vector3d& point : scene.points_ref)
    for (const auto& poses : {std::vector<SE3>{SE3(), kSecond}, {SE3(), kSecond, kThird}}) {
      const auto result = triangulate(kCamera, observations_of(point, poses), 0.01, 0.5);
      ASSERT_TRUE(result.outcome) << result.outcome.reason;
      EXPECT_LT((result.point_ref - point).norm(), 1e-8);
      EXPECT_LT(result.max_error_px, 1e-8);
      EXPECT_GE(result.parallax_rad, angle_between(point, point - kSecond.translation()) - 1e-12);
    }
}

TEST(Triangulation, LeavesTheErrorThatTheNoiseAllows) {
  Random random = seeded_random(42);
  constexpr double kNoisePx = 0.5;
  PointScene scene = make_scene(kCamera, {SE3(), kSecond, kThird}, 200, random, 6, 6);
  double sum2 = 0;
  for (std::size_t i = 0; i < scene.points_ref.size(); ++i) {
    auto observations = observations_of(scene.points_ref[i], {SE3(), kSecond, kThird});
    for (PointMeasurement& s : observations)
      s.px += kNoisePx * Eigen::Vector2d(random.normal(), random.normal());
    const auto result = triangulate(kCamera, observations, 0.01, 10 * kNoisePx);
    ASSERT_TRUE(result.outcome);
    sum2 += (result.point_ref - scene.points_ref[i]).squaredNorm();
  }
  // Depth error of two views 1 m apart: z^2 / (f b) sqrt(2) sigma = 5 cm; the third view helps.
  EXPECT_LT(std::sqrt(sum2 / 200), 0.06);
  EXPECT_GT(std::sqrt(sum2 / 200), 0.005);
}

TEST(Triangulation, RefusesOneObservationAlone) {
  EXPECT_EQ(triangulate(kCamera, {{SE3(), {100, 100}}}, 0, 1).outcome.code, Code::kTooFewData);
  EXPECT_EQ(triangulate(kCamera, {}, 0, 1).outcome.code, Code::kTooFewData);
}

TEST(Triangulation, RefusesLittleParallax) {
  const auto result = triangulate(kCamera, observations_of({0, 0, 500}, {SE3(), kSecond}), 0.01, 1);
  EXPECT_EQ(result.outcome.code, Code::kDegenerate);
  EXPECT_NEAR(result.parallax_rad, 1.0 / 500, 1e-5);
  // Parallel rays meet nowhere, whatever parallax is asked for.
  EXPECT_EQ(
      triangulate(kCamera, {{SE3(), {300, 200}}, {pose({0, 0, 0}, {1, 0, 0}), {300, 200}}}, 0, 1)
          .outcome.code,
      Code::kDegenerate);
}

TEST(Triangulation, RefusesAPointBehindTheCameras) {
  // Rays that diverge meet behind both cameras.
  std::vector<PointMeasurement> observations =
      observations_of({0.5, 0, 5}, {SE3(), pose({0, 0, 0}, {1, 0, 0})});
  std::swap(observations[0].px, observations[1].px);
  EXPECT_EQ(triangulate(kCamera, observations, 0.01, 1).outcome.code, Code::kDegenerate);
}

TEST(Triangulation, RefusesObservationsThatContradictEachOther) {
  auto observations = observations_of({0.5, 0.2, 5}, {SE3(), kSecond, kThird});
  observations[1].px.y() += 20;
  const auto result = triangulate(kCamera, observations, 0.01, 2);
  EXPECT_EQ(result.outcome.code, Code::kInconsistent);
  EXPECT_GT(result.max_error_px, 2);
}

}  // namespace triangulation_test
}  // namespace placegraph
