#pragma once
#include <placegraph/backend/factors/factor.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A measured direction from one camera to another, with unknown distance:
///
///   r = W (u - u_measured),   u = t / |t|,   t = R_a^T (t_b - t_a),   |u_measured| = 1
///   d u / d t = (I - u u^T) / |t|,   d t / d xi_a = [-I, hat(t)],   d t / d xi_b = [R_a^T R_b, 0]
///
/// Two-view geometry and three views of lines measure such a direction. W^T W = information of u;
/// its part along u has no effect. The residual is the chord, not its projection, so that the
/// opposite direction has the largest residual instead of being a second minimum. If the cameras
/// coincide, the direction is undefined and the derivatives are zero.
class BearingFactor final : public SizedFactor<3, SE3, SE3> {
 public:
  /// Measured direction in frame a, of any length except zero, and W.
  BearingFactor(const Eigen::Vector3d& direction_a, const Eigen::Matrix3d& whitening)
      : measured_(direction_a.normalized()), W_(whitening) {}

  /// The residual and its Jacobians as above; always true.
  bool compute(const SE3& T_world_a, const SE3& T_world_b, Residual& r,
               Jacobians* J) const override {
    const Eigen::Matrix3d R_a_world = T_world_a.rotation().matrix().transpose();
    const Eigen::Vector3d t = R_a_world * (T_world_b.translation() - T_world_a.translation());
    const double length = t.norm();
    const bool defined = length > 1e-12;
    const Eigen::Vector3d u = defined ? Eigen::Vector3d(t / length) : Eigen::Vector3d(0, 0, 0);
    r.noalias() = W_ * (u - measured_);
    if (!J) return true;
    Eigen::Matrix3d J_t = Eigen::Matrix3d::Zero();
    if (defined) J_t = W_ * (Eigen::Matrix3d::Identity() - u * u.transpose()) / length;
    std::get<0>(*J) << -J_t, J_t * hat(t);
    std::get<1>(*J) << J_t * R_a_world * T_world_b.rotation().matrix(), Eigen::Matrix3d::Zero();
    return true;
  }

 private:
  Eigen::Vector3d measured_;
  Eigen::Matrix3d W_;
};

}  // namespace placegraph
