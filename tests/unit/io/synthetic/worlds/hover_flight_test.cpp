#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/internal/synthetic/worlds/hover_flight.h>

namespace placegraph::synthetic {
namespace {

using Eigen::Vector3d;

HoverFlightOptions exact(double duration_s, std::uint64_t seed = 3) {
  HoverFlightOptions options;
  options.seed = seed;
  options.duration_s = duration_s;
  options.gyro_bias_sigma = options.accel_bias_sigma = 0;
  options.noise = {1e-9, 1e-9, 1e-9, 1e-9};
  return options;
}

TEST(HoverFlight, IsWhatItsInertialSensorFelt) {
  const HoverFlight flight = fly_hover(exact(5));
  ASSERT_EQ(flight.imu.samples.size(), flight.truth.size());
  SO3 R = flight.truth[0].T_world_body.rotation();
  Vector3d v = flight.truth[0].velocity_world, p = flight.truth[0].T_world_body.translation();
  const double dt = 1 / HoverFlight::kImuHz;
  for (std::size_t k = 1; k < flight.truth.size(); ++k) {
    const ImuSample &a = flight.imu.samples[k - 1], &b = flight.imu.samples[k];
    const SO3 next = R * SO3::exp(0.5 * dt * (a.gyro_rad_s + b.gyro_rad_s));
    const Vector3d accel = 0.5 * (R * a.accel_m_s2 + next * b.accel_m_s2) + gravity();
    p += dt * v + 0.5 * dt * dt * accel;
    v += dt * accel;
    R = next;
  }
  const BodyState& end = flight.truth.back();
  EXPECT_LT((R.inverse() * end.T_world_body.rotation()).log().norm(), 2e-3);
  EXPECT_LT((v - end.velocity_world).norm(), 0.02);
  EXPECT_LT((p - end.T_world_body.translation()).norm(), 0.05);
}

TEST(HoverFlight, RepeatsItselfForOneSeedOnly) {
  const HoverFlight a = fly_hover(exact(2)), b = fly_hover(exact(2)), c = fly_hover(exact(2, 4));
  EXPECT_EQ(a.imu.samples.back().gyro_rad_s, b.imu.samples.back().gyro_rad_s);
  EXPECT_NE(a.imu.samples.back().gyro_rad_s, c.imu.samples.back().gyro_rad_s);
  // A longer flight begins as the shorter one.
  const HoverFlight longer = fly_hover(exact(3));
  EXPECT_EQ(a.imu.samples.back().gyro_rad_s, longer.imu.samples[400].gyro_rad_s);
}

TEST(HoverFlight, LooksTwentyTimesASecond) {
  const HoverFlight flight = fly_hover(exact(2));
  ASSERT_EQ(flight.images.size(), 41u);
  EXPECT_EQ(flight.truth[flight.images[1]].stamp_ns - flight.truth[flight.images[0]].stamp_ns,
            50'000'000);
}

TEST(HoverFlight, RefusesOptionsOutOfRange) {
  HoverFlightOptions options;
  options.duration_s = -1;
  EXPECT_THROW((void)fly_hover(options), ArgumentError);
}

}  // namespace
}  // namespace placegraph::synthetic
