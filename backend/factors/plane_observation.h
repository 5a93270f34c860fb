#pragma once
#include <placegraph/backend/factors/factor.h>

namespace placegraph {

/// A plane measured in a sensor's frame (Kaess 2015):
///
///   r = W log(q_measured^-1 q_sensor),   q_sensor = the plane in the frame of T_world_sensor
///   d r / d xi    = W right_jacobian_inverse(log) d q_sensor / d xi
///   d r / d plane = W right_jacobian_inverse(log) d q_sensor / d plane,   see transform_to
///
/// W^T W = information of the plane's tangent, see plane_information.
class PlaneObservationFactor final : public SizedFactor<3, SE3, Plane3> {
 public:
  PlaneObservationFactor(const Plane3& plane_sensor, const Eigen::Matrix3d& whitening)
      : measured_(plane_sensor), W_(whitening) {}

  bool compute(const SE3& T_world_sensor, const Plane3& plane_world, Residual& r,
               Jacobians* J) const override {
    const Plane3 plane_sensor =
        J ? transform_to(T_world_sensor, plane_world, &std::get<0>(*J), &std::get<1>(*J))
          : transform_to(T_world_sensor, plane_world);
    const Eigen::Vector3d e = plane_sensor.minus(measured_);
    r.noalias() = W_ * e;
    if (!J) return true;
    const Eigen::Matrix3d J_e = W_ * SO3::right_jacobian_inverse(e);
    std::get<0>(*J) = J_e * std::get<0>(*J).eval();
    std::get<1>(*J) = J_e * std::get<1>(*J).eval();
    return true;
  }

 private:
  Plane3 measured_;
  Eigen::Matrix3d W_;
};

}  // namespace placegraph
