#include <gtest/gtest.h>
#include <placegraph/frontend/planes/dominant_surface.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace dominant_surface_test {

using namespace test;
using Code = Outcome::Code;
const Camera kCamera = pinhole(640, 240, 400);
constexpr double kHeight_m = 1.6, kSigma = 1e-3;

Plane tilted(double pitch_rad, double roll_rad = 0) {
  return {SO3::exp({pitch_rad, 0, roll_rad}) * Eigen::Vector3d::UnitY(), kHeight_m};
}

/// A sensor that sees a plane, and what `before` says nearer to it: inverse depth or nothing.
SurfaceDepths sensor(const Plane& plane, Random& random,
                     std::function<std::optional<double>(const Eigen::Vector3d&)> before = {}) {
  return [=, &random](const std::vector<Eigen::Vector2f>& px, const std::vector<double>&) {
    std::vector<std::optional<MeasuredInverseDepth>> depths;
    for (const Eigen::Vector2f& p : px) {
      const Eigen::Vector3d ray = *kCamera.unproject(p.cast<double>());
      double value = plane.normal.dot(ray) / plane.distance_m;
      if (before)
        if (const auto nearer = before(ray)) value = std::max(value, *nearer);
      depths.push_back(MeasuredInverseDepth{ray, value + kSigma * random.normal(), kSigma});
    }
    return depths;
  };
}

/// Something without a plane in it, always the same: depths between 1.7 and 5 m.
double random_like(const Eigen::Vector3d& ray) {
  const double x = 1e4 * std::sin(12.9898 * ray.x() + 78.233 * ray.y());
  return 0.2 + 0.4 * (x - std::floor(x));
}

double angle_deg(const Plane& a, const Plane& b) {
  return rad_to_deg(angle_between(a.normal, b.normal));
}

TEST(DominantSurface, IsFoundFromAMountingThatIsDegreesAndDecimetresOff) {
  Random random = seeded_random(81);
  const Plane truth = tilted(0.06, -0.02);
  DominantSurface surface({}, kCamera, {Eigen::Vector3d::UnitY(), 1.4});
  SurfaceAppearance appearance;
  for (int i = 0; i < 3; ++i) appearance = surface.update(sensor(truth, random), SE3(), {}, random);
  ASSERT_TRUE(appearance.outcome) << appearance.outcome.reason;
  EXPECT_EQ(appearance.region, SurfaceRegion::kAhead);
  EXPECT_LT(angle_deg(appearance.plane_cam, truth), rad_to_deg(4 * appearance.sigma_normal_rad));
  EXPECT_NEAR(std::log(appearance.plane_cam.distance_m / kHeight_m), 0,
              4 * appearance.sigma_log_distance);
  EXPECT_LT(appearance.sigma_normal_rad, deg_to_rad(0.5));
  EXPECT_LT(appearance.sigma_log_distance, 0.01);
  EXPECT_GT(appearance.share, 0.95);
}

TEST(DominantSurface, TellsVehiclesFromTheRoad) {
  Random random = seeded_random(82);
  const Plane truth = tilted(0.02);
  // A lorry's back 9 m ahead, over the right of the lane.
  const auto lorry = [](const Eigen::Vector3d& ray) -> std::optional<double> {
    if (ray.x() > 0.02 && ray.x() < 0.2 && ray.y() < 0.17) return 1 / 9.0;
    return std::nullopt;
  };
  DominantSurface surface({}, kCamera, tilted(0));
  const SurfaceAppearance appearance =
      surface.update(sensor(truth, random, lorry), SE3(), {}, random);
  ASSERT_TRUE(appearance.outcome) << appearance.outcome.reason;
  EXPECT_LT(angle_deg(appearance.plane_cam, truth), 0.5);
  ASSERT_FALSE(appearance.off_px.empty());
  int on_lorry = 0;
  for (const Eigen::Vector2f& px : appearance.off_px)
    on_lorry += lorry(*kCamera.unproject(px.cast<double>())).has_value();
  EXPECT_GT(on_lorry, 0.8 * static_cast<double>(appearance.off_px.size()));
}

TEST(DominantSurface, IsLookedAtElsewhereWhereTheRoadAheadIsHidden) {
  Random random = seeded_random(83);
  const Plane truth = tilted(0);
  // Traffic fills the lane ahead; the mask hides what is to the right.
  const auto car = [](const Eigen::Vector3d& ray) -> std::optional<double> {
    if (ray.x() > -0.3) return random_like(ray);
    return std::nullopt;
  };
  Image mask(kCamera.height, kCamera.width, CV_8UC1, cv::Scalar(255));
  mask.colRange(kCamera.width / 2 + 60, kCamera.width).setTo(0);
  DominantSurface surface({}, kCamera, truth);
  const SurfaceAppearance appearance =
      surface.update(sensor(truth, random, car), SE3(), mask, random);
  ASSERT_TRUE(appearance.outcome) << appearance.outcome.reason;
  EXPECT_EQ(appearance.region, SurfaceRegion::kLeft) << to_string(appearance.region);
  EXPECT_LT(angle_deg(appearance.plane_cam, truth), 0.5);
  for (const Eigen::Vector2f& px : appearance.on_px) EXPECT_LT(px.x(), kCamera.width / 2 + 60);
}

TEST(DominantSurface, FollowsASlopeFromTheSecondLookOn) {
  Random random = seeded_random(84);
  DominantSurface surface({}, kCamera, tilted(0));
  for (int i = 0; i < 10; ++i)
    ASSERT_TRUE(surface.update(sensor(tilted(0), random), SE3(), {}, random).outcome);
  const Plane slope = tilted(0.05);
  const SurfaceAppearance first = surface.update(sensor(slope, random), SE3(), {}, random);
  EXPECT_EQ(first.outcome.code, Code::kInconsistent);
  EXPECT_LT(angle_deg(first.plane_cam, tilted(0)), 0.5);  // not believed yet
  SurfaceAppearance appearance;
  for (int i = 0; i < 2; ++i) appearance = surface.update(sensor(slope, random), SE3(), {}, random);
  ASSERT_TRUE(appearance.outcome) << appearance.outcome.reason;
  EXPECT_LT(angle_deg(appearance.plane_cam, slope), 0.5);
}

TEST(DominantSurface, IsCarriedAlongByTheMotion) {
  Random random = seeded_random(85);
  DominantSurface surface({}, kCamera, tilted(0.02));
  ASSERT_TRUE(surface.update(sensor(tilted(0.02), random), SE3(), {}, random).outcome);
  // The camera rises by 0.3 m and nods by 3 deg, and sees nothing.
  const SE3 T_cur_last = pose({0.05, 0, 0}, {0, 0.3, 0});
  const Plane before = surface.plane_cam(), expected = transform(T_cur_last, before);
  const auto blind = [](const std::vector<Eigen::Vector2f>& px, const std::vector<double>&) {
    return std::vector<std::optional<MeasuredInverseDepth>>(px.size());
  };
  const SurfaceAppearance appearance = surface.update(blind, T_cur_last, {}, random);
  EXPECT_EQ(appearance.outcome.code, Code::kTooFewData);
  EXPECT_LT(angle_deg(appearance.plane_cam, expected), 1e-6);
  EXPECT_NEAR(appearance.plane_cam.distance_m, expected.distance_m, 1e-9);
}

TEST(DominantSurface, RefusesWallsOfNoiseAndMasksOfAnotherSize) {
  Random random = seeded_random(86);
  DominantSurface surface({}, kCamera, tilted(0));
  const auto clutter = [&](const std::vector<Eigen::Vector2f>& px, const std::vector<double>&) {
    std::vector<std::optional<MeasuredInverseDepth>> depths;
    for (const Eigen::Vector2f& p : px)
      depths.push_back(MeasuredInverseDepth{*kCamera.unproject(p.cast<double>()),
                                            random.uniform(0.02, 0.6), kSigma});
    return depths;
  };
  EXPECT_EQ(surface.update(clutter, SE3(), {}, random).outcome.code, Code::kNoConsensus);
  EXPECT_THROW((void)surface.update(clutter, SE3(), Image::zeros(3, 3, CV_8UC1), random),
               ArgumentError);
  EXPECT_THROW(DominantSurface({}, kCamera, {Eigen::Vector3d::UnitY(), -1}), ArgumentError);
  DominantSurfaceOptions inside_out;
  inside_out.near_heights = 20;
  EXPECT_THROW(DominantSurface(inside_out, kCamera, tilted(0)), ArgumentError);
}

}  // namespace dominant_surface_test
}  // namespace placegraph
