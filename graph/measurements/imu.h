#pragma once
#include <Eigen/Core>
#include <cstdint>

namespace [[gnu::visibility("default")]] placegraph {

/// One reading of gyroscope and accelerometer, in the body frame.
struct ImuSample {
  std::int64_t stamp_ns = 0;                             ///< time of the reading
  Eigen::Vector3d gyro_rad_s = Eigen::Vector3d::Zero();  ///< angular velocity, bias included
  Eigen::Vector3d accel_m_s2 = Eigen::Vector3d::Zero();  ///< specific force: -gravity at rest
};

/// Noise densities of gyroscope and accelerometer, and of the random walks of their biases.
struct ImuNoise {
  double gyro = 0;             ///< white noise [rad / s / sqrt(Hz)]
  double accel = 0;            ///< white noise [m / s^2 / sqrt(Hz)]
  double gyro_bias_walk = 0;   ///< random walk of the gyroscope bias [rad / s^2 / sqrt(Hz)]
  double accel_bias_walk = 0;  ///< random walk of the accelerometer bias [m / s^3 / sqrt(Hz)]
};

/// The acceleration of free fall in a frame whose z axis points up [m/s^2].
inline Eigen::Vector3d gravity() { return {0, 0, -9.80665}; }

}  // namespace placegraph
