#pragma once
#include <placegraph/graph/geometry/se3.h>

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

/// A pose of the body measured from a marker.
struct PoseMeasurement {
  std::int64_t stamp_ns = 0;
  SE3 T_world_body;
  Matrix6d covariance = Matrix6d::Identity();  ///< right tangent
};

/// Derotated flow over the floor between two images (VentralMotion of a camera).
/// `over_distance` is the camera's translation over its distance from the floor at the first image,
/// in the camera's axes at that image.
struct FlowMeasurement {
  std::int64_t from_ns = 0, to_ns = 0;
  Eigen::Vector3d over_distance = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
  /// Derivative of `over_distance` by the camera's rotation between the images (right tangent, in
  /// the camera's axes), if the rotation was measured by the body's gyroscope: then its error is
  /// also an error of the body's attitude. In that case `covariance` does not include the error of
  /// the rotation.
  std::optional<Eigen::Matrix3d> J_rotation = std::nullopt;
  SO3 R_from_to = {};  ///< rotation of the camera that was removed from the flow; with `J_rotation`
  /// Gyroscope bias that was assumed in that rotation [rad/s]; with `J_rotation`.
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();
};

/// Pose, velocity and sensor biases of a body.
///
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
