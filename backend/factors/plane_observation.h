#pragma once
#include <placegraph/backend/factors/factor.h>

#include <Eigen/LU>

namespace [[gnu::visibility("default")]] placegraph {

/// A plane measured in a sensor's frame (Kaess 2015):
///
///   r = W log(q_measured^-1 q_sensor),   q_sensor = the plane in the frame of T_world_sensor
///   d r / d xi    = W right_jacobian_inverse(log) d q_sensor / d xi
///   d r / d plane = W right_jacobian_inverse(log) d q_sensor / d plane,   see transform_to
///
/// W^T W = information of the plane's tangent, see plane_information.
class PlaneObservationFactor final : public SizedFactor<3, SE3, Plane3> {
 public:
  /// The measured plane in the sensor's frame, and W.
  PlaneObservationFactor(const Plane3& plane_sensor, const Eigen::Matrix3d& whitening)
      : measured_(plane_sensor), W_(whitening) {}

  /// The residual and its Jacobians as above; always true.
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
  /// The measured plane in the new scale.
  /// The tangent of a plane is not linear in the scale, so the residual is the same only to first
  /// order of the error.
  std::shared_ptr<const Factor> transformed(const Sim3& S_new_old) const override {
    const auto result = std::make_shared<PlaneObservationFactor>(*this);
    if (S_new_old.scale() == 1.0) return result;
    Eigen::Matrix3d J_new_old;
    result->measured_ = scaled(measured_, S_new_old.scale(), &J_new_old);
    result->W_ = W_ * J_new_old.inverse();
    return result;
  }

 private:
  /// The plane with its distance multiplied by `scale`, and the derivative of its tangent by that
  /// of `plane`.
  static Plane3 scaled(const Plane3& plane, double scale, Eigen::Matrix3d* J_new_old) {
    Eigen::Matrix3d J_normal_old, J_normal_new;
    Eigen::RowVector3d J_distance_old, J_distance_new;
    const Eigen::Vector3d n_old = plane.normal(&J_normal_old);
    const Plane3 result(n_old, scale * plane.distance(&J_distance_old));
    const double sign = result.normal(&J_normal_new).dot(n_old) < 0 ? -1 : 1;
    result.distance(&J_distance_new);
    Eigen::Matrix<double, 4, 3> J_old, J_new;  // [normal, distance] by either tangent
    J_old << sign * J_normal_old, sign * scale * J_distance_old;
    J_new << J_normal_new, J_distance_new;
    *J_new_old = (J_new.transpose() * J_new).inverse() * J_new.transpose() * J_old;
    return result;
  }

  Plane3 measured_;
  Eigen::Matrix3d W_;
};

}  // namespace placegraph
