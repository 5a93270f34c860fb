#pragma once
#include <placegraph/backend/factors/factor.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A Manhattan frame measured in a camera, e.g. by the vanishing points of its image:
///
///   r = W log(E),   E = R_world_manhattan^T R_world_cam R_cam_manhattan
///   d r / d phi_cam       =  W right_jacobian_inverse(log E) R_cam_manhattan^T
///   d r / d phi_manhattan = -W right_jacobian_inverse(log E) E^T
///
/// W^T W = information about the rotation of E on the right, of any rank: an image whose lines have
/// fewer than two directions leaves a rotation undetermined. The measurement selects one of the 24
/// frames along the same axes. To measure a camera's absolute rotation, hold the variable
/// R_world_manhattan.
class AbsoluteRotationFactor final : public SizedFactor<3, SE3, SO3> {
 public:
  /// Measured rotation and W [1/rad].
  AbsoluteRotationFactor(const SO3& R_cam_manhattan, const Eigen::Matrix3d& whitening)
      : R_cam_manhattan_(R_cam_manhattan), W_(whitening) {}

  /// The residual and its Jacobians as above; always true.
  bool compute(const SE3& T_world_cam, const SO3& R_world_manhattan, Residual& r,
               Jacobians* J) const override {
    const SO3 E = R_world_manhattan.inverse() * T_world_cam.rotation() * R_cam_manhattan_;
    const Eigen::Vector3d e = E.log();
    r.noalias() = W_ * e;
    if (!J) return true;
    const Eigen::Matrix3d J_E = W_ * SO3::right_jacobian_inverse(e);
    std::get<0>(*J).leftCols<3>().setZero();
    std::get<0>(*J).rightCols<3>().noalias() = J_E * R_cam_manhattan_.matrix().transpose();
    std::get<1>(*J).noalias() = -J_E * E.matrix().transpose();
    return true;
  }
  /// A copy: the measurement is independent of the world frame and the scale.
  std::shared_ptr<const Factor> transformed(const Sim3&) const override {
    return std::make_shared<AbsoluteRotationFactor>(*this);
  }

 private:
  SO3 R_cam_manhattan_;
  Eigen::Matrix3d W_;
};

}  // namespace placegraph
