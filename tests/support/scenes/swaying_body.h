#pragma once
#include <placegraph/backend/inertial/error_state_filter.h>
#include <placegraph/graph/core/random.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace placegraph::test {

/// A body that sways over a level floor, and what its sensors say.
struct SwayingBody {
  std::uint64_t seed = 1;
  double duration_s = 10, imu_hz = 200, image_hz = 20;
  double height_m = 1.5;
  ErrorStateFilterOptions noise{};
  SE3 T_body_cam{SO3::exp({std::numbers::pi, 0, 0}), Eigen::Vector3d(0.05, 0.02, -0.03)};
  Eigen::Vector3d gyro_bias{0.004, -0.003, 0.002}, accel_bias{0.05, -0.04, 0.03};
  double flow_sigma = 2e-4;  ///< of the way over the distance, per image
  double marker_sigma_m = 0.01, marker_sigma_rad = 0.01;

  static std::int64_t stamp(double t) { return static_cast<std::int64_t>(std::llround(t * 1e9)); }

  Eigen::Vector3d position(double t) const {
    return {0.6 * std::sin(0.9 * t), 0.5 * std::sin(1.3 * t + 0.4),
            height_m + 0.2 * std::sin(0.6 * t)};
  }
  SO3 rotation(double t) const {
    return SO3::exp({0, 0, 0.4 * std::sin(0.5 * t)}) *
           SO3::exp({0.08 * std::sin(1.7 * t), 0.07 * std::cos(1.4 * t), 0});
  }
  SE3 pose(double t) const { return {rotation(t), position(t)}; }
  Eigen::Vector3d velocity(double t) const {
    return (position(t + 1e-4) - position(t - 1e-4)) / 2e-4;
  }

  BodyState start(Random& random) const {
    BodyState state;
    Eigen::Matrix<double, 15, 1> sigma;
    sigma << 0.02, 0.02, 0.02, 0.05, 0.05, 0.05, 0.02, 0.02, 0.02, 0.004, 0.004, 0.004, 0.05, 0.05,
        0.05;
    state.covariance = sigma.cwiseAbs2().asDiagonal();
    Eigen::Matrix<double, 15, 1> e;
    for (int i = 0; i < 15; ++i) e[i] = sigma[i] * random.normal();
    state.T_world_body =
        SE3(rotation(0) * SO3::exp(e.segment<3>(6)), Eigen::Vector3d(position(0) + e.head<3>()));
    state.velocity_world = velocity(0) + e.segment<3>(3);
    state.gyro_bias = gyro_bias + e.segment<3>(9);
    state.accel_bias = accel_bias + e.segment<3>(12);
    return state;
  }
  ImuSample imu(double t, Random& random) const {
    const double h = 1e-3, dt = 1 / imu_hz;
    ImuSample sample;
    sample.stamp_ns = stamp(t);
    const auto normal = [&](double sigma) {
      return Eigen::Vector3d(random.normal(0, sigma), random.normal(0, sigma),
                             random.normal(0, sigma));
    };
    sample.gyro_rad_s = (rotation(t - h).inverse() * rotation(t + h)).log() / (2 * h) + gyro_bias +
                        normal(noise.gyro_noise / std::sqrt(dt));
    const Eigen::Vector3d accel = (position(t + h) - 2 * position(t) + position(t - h)) / (h * h);
    sample.accel_m_s2 =
        rotation(t).inverse() * Eigen::Vector3d(accel + Eigen::Vector3d(0, 0, 9.80665)) +
        accel_bias + normal(noise.accel_noise / std::sqrt(dt));
    return sample;
  }
  FlowMeasurement flow(double from, double to, Random& random) const {
    const SE3 T_first = pose(from) * T_body_cam, T_second = pose(to) * T_body_cam;
    FlowMeasurement observation;
    observation.from_ns = stamp(from);
    observation.to_ns = stamp(to);
    observation.over_distance =
        (T_first.inverse() * T_second).translation() / T_first.translation().z();
    for (int i = 0; i < 3; ++i) observation.over_distance[i] += random.normal(0, flow_sigma);
    observation.covariance = flow_sigma * flow_sigma * Eigen::Matrix3d::Identity();
    return observation;
  }
  PoseMeasurement marker(double t, Random& random) const {
    PoseMeasurement observation;
    observation.stamp_ns = stamp(t);
    Vector6d sigma, e;
    sigma << Eigen::Vector3d::Constant(marker_sigma_m), Eigen::Vector3d::Constant(marker_sigma_rad);
    for (int i = 0; i < 6; ++i) e[i] = sigma[i] * random.normal();
    observation.T_world_body = pose(t).plus(e);
    observation.covariance = sigma.cwiseAbs2().asDiagonal();
    return observation;
  }
};

}  // namespace placegraph::test
