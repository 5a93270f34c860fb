#pragma once
#include <placegraph/graph/geometry/se3.h>

#include <Eigen/Core>
#include <cstdint>
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

}  // namespace placegraph
