#pragma once
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/measurements/flight_measurement.h>

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

/// Pose, velocity and sensor biases of a body.
/// World: z up, gravity along -z; body: the inertial sensor's axes.
struct BodyState {
  std::int64_t stamp_ns = 0;
  SE3 T_world_body;
  Eigen::Vector3d velocity_world = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero(), accel_bias = Eigen::Vector3d::Zero();
  /// Covariance of the errors of position and velocity (world axes), attitude (right tangent),
  /// gyroscope bias and accelerometer bias, three each.
  Eigen::Matrix<double, 15, 15> covariance = Eigen::Matrix<double, 15, 15>::Zero();
};

/// Prediction of the state at one time, before the measurement of that time is used.
struct BodyExpectation {
  std::optional<BodyState> state;  ///< empty: the estimator has no estimate for that time
  /// Squared Mahalanobis distance of a pose measured at that time from the prediction, with both
  /// covariances (chi^2, six degrees of freedom); nothing if the estimator has no prediction.
  std::function<std::optional<double>(const PoseMeasurement&)> deviation2;
};

}  // namespace placegraph
