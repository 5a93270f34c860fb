#pragma once
#include <placegraph/graph/geometry/se3.h>

#include <Eigen/Core>
#include <cstdint>
#include <optional>

namespace placegraph {

/// The body's pose as a marker tells it.
struct PoseMeasurement {
  std::int64_t stamp_ns = 0;
  SE3 T_world_body;
  Matrix6d covariance = Matrix6d::Identity();  ///< right tangent
};

/// Derotated flow over the floor between two images (VentralMotion of a camera): the camera's way
/// over its distance from the floor at the first, in the camera's axes there.
struct FlowMeasurement {
  std::int64_t from_ns = 0, to_ns = 0;
  Eigen::Vector3d over_distance = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
  /// How `over_distance` hangs on the camera's turn between the images (by its right tangent, in
  /// the camera's axes), where the body's gyro told that turn: what is wrong with it is wrong with
  /// the body's attitude, too. `covariance` is without the turn's share then.
  std::optional<Eigen::Matrix3d> J_rotation = std::nullopt;
  SO3 R_from_to = {};  ///< the camera's turn that was taken out of the flow; with `J_rotation`
  /// The bias that the gyro was thought to have when it told that turn [rad/s]; with `J_rotation`.
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();
};

}  // namespace placegraph
