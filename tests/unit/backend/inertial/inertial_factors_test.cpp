#include <gtest/gtest.h>
#include <placegraph/backend/inertial/inertial_factors.h>

#include "tests/support/scenes/swaying_body.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace inertial_factors_test {

using test::SwayingBody;

BodyState truth(const SwayingBody& flight, double t) {
  BodyState state;
  state.stamp_ns = SwayingBody::stamp(t);
  state.T_world_body = flight.pose(t);
  state.velocity_world = flight.velocity(t);
  state.gyro_bias = flight.gyro_bias;
  state.accel_bias = flight.accel_bias;
  return state;
}

StateStep random_step(Random& random, double sigma) {
  StateStep step;
  for (int i = 0; i < 15; ++i) step[i] = random.normal(0, sigma);
  return step;
}

/// Samples of `flight` from `from` to `to`, in its own noise.
ImuPreintegration integrate(const SwayingBody& flight, double from, double to,
                            const ImuNoise& noise, Random& random,
                            const Eigen::Vector3d& bias_off = Eigen::Vector3d::Zero()) {
  ImuPreintegration motion(flight.gyro_bias + bias_off, flight.accel_bias + bias_off, noise);
  const double dt = 1 / flight.imu_hz;
  ImuSample before = flight.imu(from, random);
  const int steps = static_cast<int>(std::lround((to - from) / dt));
  for (int i = 1; i <= steps; ++i) {
    const ImuSample now = flight.imu(from + i * dt, random);
    motion.add(0.5 * (before.gyro_rad_s + now.gyro_rad_s),
               0.5 * (before.accel_m_s2 + now.accel_m_s2), dt);
    before = now;
  }
  return motion;
}

SwayingBody still_sensors() {
  SwayingBody flight;
  flight.imu_hz = 1000;
  flight.noise.gyro_noise = flight.noise.accel_noise = 1e-9;
  return flight;
}
const ImuNoise kNoise{2e-3, 2e-2, 2e-5, 5e-4};

template <class Error>
void expect_jacobians(const Error& error_at, const BodyState& first, const BodyState& second) {
  const StateError error = error_at(first, second);
  const double h = 1e-5;
  for (int k = 0; k < 15; ++k) {
    const StateStep step = h * StateStep::Unit(k);
    const Eigen::VectorXd by_first =
        (error_at(moved(first, step), second).r - error_at(moved(first, -step), second).r) /
        (2 * h);
    EXPECT_LT((by_first - error.J_first.col(k)).norm(), 1e-6) << k;
    if (error.J_second.size() == 0) continue;
    const Eigen::VectorXd by_second =
        (error_at(first, moved(second, step)).r - error_at(first, moved(second, -step)).r) /
        (2 * h);
    EXPECT_LT((by_second - error.J_second.col(k)).norm(), 1e-6) << k;
  }
}

TEST(InertialFactors, DerivativesAreThoseOfFiniteDifferences) {
  Random random = test::seeded_random(1);
  const SwayingBody flight;
  const ImuPreintegration motion = integrate(flight, 1, 1.2, kNoise, random);
  const BodyState first = moved(truth(flight, 1), random_step(random, 0.05));
  const BodyState second = moved(truth(flight, 1.2), random_step(random, 0.05));
  expect_jacobians(
      [&](const BodyState& a, const BodyState& b) { return inertial_error(motion, a, b); }, first,
      second);
  const PoseMeasurement seen = flight.marker(1, random);
  expect_jacobians([&](const BodyState& a, const BodyState&) { return pose_error(seen, a); }, first,
                   second);
  const FlowMeasurement flow = flight.flow(1, 1.2, random);
  expect_jacobians(
      [&](const BodyState& a, const BodyState& b) {
        return *flow_error(flow, flight.T_body_cam, 0.1, a, b);
      },
      first, second);
}

/// Flow from which a turn was taken out that is wrong by `wrong`.
FlowMeasurement with_rotation(const SwayingBody& flight, double from, double to,
                              const Eigen::Vector3d& wrong, Random& random) {
  FlowMeasurement flow = flight.flow(from, to, random);
  Eigen::Matrix3d J;
  J << 0.1, 1.1, 0, -0.9, 0, 0.2, 0.05, 0, 0.1;
  const SE3 T_first = flight.pose(from) * flight.T_body_cam;
  const SE3 T_second = flight.pose(to) * flight.T_body_cam;
  flow.R_from_to = T_first.rotation().inverse() * T_second.rotation() * SO3::exp(wrong);
  flow.over_distance += J * wrong;
  flow.J_rotation = J;
  return flow;
}

TEST(InertialFactors, RemoveAWrongRotationFromTheFlowAgain) {
  Random random = test::seeded_random(5);
  SwayingBody flight;
  flight.flow_sigma = 1e-12;
  const BodyState first = truth(flight, 2), second = truth(flight, 2.1);
  const FlowMeasurement flow = with_rotation(flight, 2, 2.1, {0.02, -0.01, 0.015}, random);
  EXPECT_LT(flow_error(flow, flight.T_body_cam, 0, first, second)->r.norm(), 1e-9);
  const BodyState a = moved(first, random_step(random, 0.05));
  const BodyState b = moved(second, random_step(random, 0.05));
  expect_jacobians(
      [&](const BodyState& x, const BodyState& y) {
        return *flow_error(flow, flight.T_body_cam, 0.1, x, y);
      },
      a, b);
}

TEST(InertialFactors, VanishAtTheTruth) {
  Random random = test::seeded_random(2);
  SwayingBody flight = still_sensors();
  flight.flow_sigma = 1e-12;
  const BodyState first = truth(flight, 2), second = truth(flight, 2.5);
  const ImuPreintegration motion = integrate(flight, 2, 2.5, kNoise, random);
  EXPECT_LT(inertial_error(motion, first, second).r.norm(), 1e-4);
  EXPECT_LT(flow_error(flight.flow(2, 2.5, random), flight.T_body_cam, 0, first, second)->r.norm(),
            1e-9);
  BodyState below = first;
  below.T_world_body = SE3(SO3(), {0, 0, -1});
  EXPECT_FALSE(flow_error(flight.flow(2, 2.5, random), flight.T_body_cam, 0, below, second));
  const StateStep step = random_step(random, 0.1);
  EXPECT_LT((difference(first, moved(first, step)) - step).norm(), 1e-12);
}

TEST(ImuPreintegration, TakesOtherBiasesInToFirstOrder) {
  Random random = test::seeded_random(3);
  const SwayingBody flight = still_sensors();
  const Eigen::Vector3d off(0.003, -0.002, 0.001);
  const ImuPreintegration here = integrate(flight, 1, 1.3, kNoise, random);
  const ImuPreintegration there = integrate(flight, 1, 1.3, kNoise, random, off);
  const auto a = here.change(flight.gyro_bias + off, flight.accel_bias + off);
  const auto b = there.change(flight.gyro_bias + off, flight.accel_bias + off);
  EXPECT_LT((a.position - b.position).norm(), 1e-5);
  EXPECT_LT((a.velocity - b.velocity).norm(), 1e-5);
  EXPECT_LT((a.rotation.inverse() * b.rotation).log().norm(), 1e-6);
}

TEST(ImuPreintegration, CovarianceIsThatOfManyIntegrations) {
  Random random = test::seeded_random(4);
  SwayingBody flight;
  flight.noise.gyro_noise = kNoise.gyro;
  flight.noise.accel_noise = kNoise.accel;
  const BodyState first = truth(flight, 1), second = truth(flight, 1.2);
  double sum = 0;
  constexpr int kTrials = 150;
  for (int trial = 0; trial < kTrials; ++trial) {
    const ImuPreintegration motion = integrate(flight, 1, 1.2, kNoise, random);
    const Eigen::VectorXd r = inertial_error(motion, first, second).r.head(9);
    sum += r.dot(motion.covariance().ldlt().solve(r)) / 9;
  }
  // Deviation of the mean 0.04; the mean of two samples at either end of a step is not quite white.
  EXPECT_NEAR(sum / kTrials, 1, 0.25);
}

}  // namespace inertial_factors_test
}  // namespace placegraph
