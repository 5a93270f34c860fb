#pragma once
#include <placegraph/backend/factors/factor.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Two planes that are nearly orthogonal, such as wall and floor:
///
///   r = n_a^T n_b / sigma = cosine of the angle between them / sigma
///   d r / d w_a = n_b^T d n_a / d w_a / sigma,   d r / d w_b = n_a^T d n_b / d w_b / sigma
class PlaneOrthogonalFactor final : public SizedFactor<1, Plane3, Plane3> {
 public:
  /// Standard deviation of the angle from a right angle [rad], which must be positive.
  explicit PlaneOrthogonalFactor(double sigma_rad) : inverse_sigma_(1.0 / sigma_rad) {}

  /// The residual and its Jacobians as above; always true.
  bool compute(const Plane3& plane_a, const Plane3& plane_b, Residual& r,
               Jacobians* J) const override {
    Eigen::Matrix3d J_a, J_b;
    const Eigen::Vector3d n_a = plane_a.normal(&J_a), n_b = plane_b.normal(&J_b);
    r[0] = inverse_sigma_ * n_a.dot(n_b);
    if (!J) return true;
    std::get<0>(*J).noalias() = inverse_sigma_ * n_b.transpose() * J_a;
    std::get<1>(*J).noalias() = inverse_sigma_ * n_a.transpose() * J_b;
    return true;
  }
  /// A copy: an angle is independent of the world frame and the scale.
  std::shared_ptr<const Factor> transformed(const Sim3&) const override {
    return std::make_shared<PlaneOrthogonalFactor>(*this);
  }

 private:
  double inverse_sigma_;
};

}  // namespace placegraph
