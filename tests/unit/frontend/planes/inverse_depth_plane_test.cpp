#include <gtest/gtest.h>
#include <placegraph/frontend/planes/inverse_depth_plane.h>

#include <Eigen/Cholesky>

#include "tests/support/seed.h"

namespace placegraph {
namespace inverse_depth_plane_test {

using test::seeded_random;
using Code = Outcome::Code;
const Plane kRoad{Eigen::Vector3d(0.02, 1, -0.05).normalized(), 1.65};
constexpr double kSigma = 1e-3;

/// Pixels below the horizon, on the road up to noise.
std::vector<MeasuredInverseDepth> road(int count, double noise, Random& random) {
  std::vector<MeasuredInverseDepth> pixels;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d ray(random.uniform(-0.5, 0.5), random.uniform(0.12, 0.4), 1);
    const double value = kRoad.normal.dot(ray) / kRoad.distance_m;
    pixels.push_back({ray, value + noise * kSigma * random.normal(), kSigma});
  }
  return pixels;
}

TEST(InverseDepthPlane, IsExactWithoutNoise) {
  Random random = seeded_random(61);
  const auto plane = fit_inverse_depth_plane(road(60, 0, random), {}, random);
  ASSERT_TRUE(plane.outcome) << plane.outcome.reason;
  EXPECT_TRUE(plane.plane_cam.normal.isApprox(kRoad.normal, 1e-9));
  EXPECT_NEAR(plane.plane_cam.distance_m, 1.65, 1e-9);
  EXPECT_EQ(plane.inliers.size(), 60u);
}

TEST(InverseDepthPlane, IsFoundUnderVehiclesAndClaimsWhatItsErrorsBearOut) {
  Random random = seeded_random(62);
  constexpr int kRuns = 60;
  double nees = 0;
  for (int run = 0; run < kRuns; ++run) {
    auto pixels = road(150, 1, random);
    // A third stands upright, 8 m ahead.
    for (std::size_t i = 0; i < pixels.size(); i += 3) pixels[i].value = 1 / 8.0;
    const auto plane = fit_inverse_depth_plane(pixels, {}, random);
    ASSERT_TRUE(plane.outcome) << plane.outcome.reason;
    const Eigen::Vector3d error = plane.g_cam - kRoad.normal / kRoad.distance_m;
    nees += error.dot(plane.covariance.ldlt().solve(error)) / kRuns;
  }
  // chi2 of 3 over 60 runs: 99.9 % lie within 3 +- 3.29 sqrt(6 / 60). Where the vehicle stands on
  // the road a few of its pixels pass for road, and the cut at 3 sigma leaves out as few.
  EXPECT_GT(nees, 3 - 3.29 * std::sqrt(6.0 / kRuns));
  EXPECT_LT(nees, 1.25 * (3 + 3.29 * std::sqrt(6.0 / kRuns)));
}

TEST(InverseDepthPlane, OfOneRowLeavesTheNormalOpen) {
  Random random = seeded_random(63);
  auto pixels = road(80, 0, random);
  for (MeasuredInverseDepth& pixel : pixels) {
    pixel.ray_cam.y() = 0.2 + 1e-4 * random.normal();
    pixel.value = kRoad.normal.dot(pixel.ray_cam) / kRoad.distance_m + kSigma * random.normal();
  }
  EXPECT_EQ(fit_inverse_depth_plane(pixels, {}, random).outcome.code, Code::kDegenerate);
}

TEST(InverseDepthPlane, RefusesTooFewPixelsAndCrowdsWithoutAPlane) {
  Random random = seeded_random(64);
  EXPECT_EQ(fit_inverse_depth_plane(road(10, 1, random), {}, random).outcome.code,
            Code::kTooFewData);
  auto pixels = road(80, 1, random);
  for (MeasuredInverseDepth& pixel : pixels) pixel.value = random.uniform(0.01, 1);
  EXPECT_EQ(fit_inverse_depth_plane(pixels, {}, random).outcome.code, Code::kNoConsensus);
}

TEST(InverseDepthPlane, ConvertsItsCovarianceIntoDegreesAndShares) {
  // g along y of length 0.5: a deviation of 0.01 along it is 2 %, of 0.005 across it 0.01 rad.
  const Eigen::Matrix3d covariance = Eigen::Vector3d(2.5e-5, 1e-4, 1e-6).asDiagonal();
  EXPECT_NEAR(sigma_log_distance({0, 0.5, 0}, covariance), 0.02, 1e-12);
  EXPECT_NEAR(sigma_normal_rad({0, 0.5, 0}, covariance), 0.01, 1e-12);
}

}  // namespace inverse_depth_plane_test
}  // namespace placegraph
