#pragma once
#include <placegraph/graph/core/se3.h>

#include <Eigen/Core>
#include <cstdint>

namespace placegraph {

/// Where and how the body moves. World: z up, gravity along -z; body: the inertial sensor's axes.
struct BodyState {
  std::int64_t stamp_ns = 0;
  SE3 T_world_body;
  Eigen::Vector3d velocity_world = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero(), accel_bias = Eigen::Vector3d::Zero();
  /// Errors of position and velocity (world axes), attitude (right tangent), gyro's and
  /// accelerometer's bias, three each.
  Eigen::Matrix<double, 15, 15> covariance = Eigen::Matrix<double, 15, 15>::Zero();
};

}  // namespace placegraph
