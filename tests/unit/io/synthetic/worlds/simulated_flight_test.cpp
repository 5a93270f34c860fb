#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/synthetic/worlds/simulated_flight.h>

namespace placegraph::synthetic {
namespace simulated_flight_test {

using Eigen::Vector3d;

SimulatedFlightOptions exact(double duration_s, std::uint64_t seed = 3) {
  SimulatedFlightOptions options;
  options.seed = seed;
  options.duration_s = duration_s;
  options.gyro_bias_sigma = options.accel_bias_sigma = 0;
  options.noise = {1e-9, 1e-9, 1e-9, 1e-9};
  return options;
}

TEST(SimulatedFlight, IsWhatItsInertialSensorFelt) {
  const SimulatedFlight flight = simulate_flight(exact(5));
  ASSERT_EQ(flight.imu.samples.size(), flight.truth.size());
  SO3 R = flight.truth[0].T_world_body.rotation();
  Vector3d v = flight.truth[0].velocity_world, p = flight.truth[0].T_world_body.translation();
  const double dt = 1 / SimulatedFlight::kImuHz;
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

TEST(SimulatedFlight, RepeatsItselfForOneSeedOnly) {
  const SimulatedFlight a = simulate_flight(exact(2)), b = simulate_flight(exact(2)),
                        c = simulate_flight(exact(2, 4));
  EXPECT_EQ(a.imu.samples.back().gyro_rad_s, b.imu.samples.back().gyro_rad_s);
  EXPECT_NE(a.imu.samples.back().gyro_rad_s, c.imu.samples.back().gyro_rad_s);
  // A longer flight begins as the shorter one.
  const SimulatedFlight longer = simulate_flight(exact(3));
  EXPECT_EQ(a.imu.samples.back().gyro_rad_s, longer.imu.samples[400].gyro_rad_s);
}

TEST(SimulatedFlight, LooksTwentyTimesASecond) {
  const SimulatedFlight flight = simulate_flight(exact(2));
  ASSERT_EQ(flight.images.size(), 41u);
  EXPECT_EQ(flight.truth[flight.images[1]].stamp_ns - flight.truth[flight.images[0]].stamp_ns,
            50'000'000);
}

TEST(SimulatedFlight, RefusesOptionsOutOfRange) {
  SimulatedFlightOptions options;
  options.duration_s = -1;
  EXPECT_THROW((void)simulate_flight(options), ArgumentError);
}

}  // namespace simulated_flight_test
}  // namespace placegraph::synthetic
