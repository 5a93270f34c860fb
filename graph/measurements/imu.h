#pragma once
#include <Eigen/Core>
#include <cstdint>

namespace [[gnu::visibility("default")]] placegraph {

/// What gyro and accelerometer say at one time, in the body's axes.
struct ImuSample {
  std::int64_t stamp_ns = 0;
  Eigen::Vector3d gyro_rad_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d accel_m_s2 = Eigen::Vector3d::Zero();  ///< specific force: -gravity at rest
};

/// How gyro and accelerometer err: densities of their white noise and of their biases' random
/// walks.
struct ImuNoise {
  double gyro = 0;             ///< [rad / s / sqrt(Hz)]
  double accel = 0;            ///< [m / s^2 / sqrt(Hz)]
  double gyro_bias_walk = 0;   ///< [rad / s^2 / sqrt(Hz)]
  double accel_bias_walk = 0;  ///< [m / s^3 / sqrt(Hz)]
};

/// Gravity where z points up [m/s^2].
inline Eigen::Vector3d gravity() { return {0, 0, -9.80665}; }

}  // namespace placegraph
