#pragma once
#include <placegraph/graph/geometry/lie.h>

namespace [[gnu::visibility("default")]] placegraph {

/// The error T_world_node * lever_arm - position_world [m], with its derivative.
/// The derivative is by T_world_node exp(xi):
///
///   d e / d rho = s R,   d e / d phi = -s R hat(lever_arm),   d e / d log s = s R lever_arm
///
/// A node of SE(2) is in the plane: the third component of the error is zero.
template <class Group>
struct PositionLinearization {
  Eigen::Vector3d e = Eigen::Vector3d::Zero();  ///< error in the world frame [m]
  /// Derivative of the error by the tangent of the pose.
  Eigen::Matrix<double, 3, Group::kDof> J = Eigen::Matrix<double, 3, Group::kDof>::Zero();

  /// Linearizes at a pose.
  PositionLinearization(const Group& T_world_node, const Eigen::Vector3d& lever_arm,
                        const Eigen::Vector3d& position_world) {
    if constexpr (Group::kDof == 3) {
      const Eigen::Vector2d arm = lever_arm.head<2>();
      e.head<2>() = T_world_node * arm - position_world.head<2>();
      const Eigen::Matrix2d R = T_world_node.rotation().matrix();
      J.template topLeftCorner<2, 2>() = R;
      J.template topRightCorner<2, 1>() = R * Eigen::Vector2d(-arm[1], arm[0]);
    } else {
      e = T_world_node * lever_arm - position_world;
      Eigen::Matrix3d sR = T_world_node.rotation().matrix();
      if constexpr (Group::kDof == 7) sR *= T_world_node.scale();
      J.template leftCols<3>() = sR;
      J.template middleCols<3>(3) = -sR * hat(lever_arm);
      if constexpr (Group::kDof == 7) J.col(6) = sR * lever_arm;
    }
  }
};

}  // namespace placegraph
