#pragma once
#include <placegraph/backend/factors/factor.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A measured distance between the origins of two poses, in standard deviations:
///
///   r = (|t_b - t_a| - distance) / sigma,   u = (t_b - t_a) / |t_b - t_a|
///   d r / d xi_a = [-u^T R_a, 0] / sigma,   d r / d xi_b = [u^T R_b, 0] / sigma
///
/// (T exp(xi) moves the origin by R rho.) If the origins coincide, the direction is undefined and
/// the derivatives are zero.
class DistanceFactor final : public SizedFactor<1, SE3, SE3> {
 public:
  /// Measured distance and its standard deviation, which must be positive.
  DistanceFactor(double distance_m, double sigma_m)
      : distance_(distance_m), inverse_(1.0 / sigma_m) {}

  /// The residual and its Jacobians as above; always true.
  bool compute(const SE3& T_map_a, const SE3& T_map_b, Residual& r, Jacobians* J) const override {
    const Eigen::Vector3d t_a_b_map = T_map_b.translation() - T_map_a.translation();
    const double length = t_a_b_map.norm();
    r[0] = (length - distance_) * inverse_;
    if (!J) return true;
    const Eigen::RowVector3d u = length > 1e-12 ? Eigen::RowVector3d(t_a_b_map.transpose() / length)
                                                : Eigen::RowVector3d::Zero();
    std::get<0>(*J) << -inverse_ * u * T_map_a.rotation().matrix(), 0, 0, 0;
    std::get<1>(*J) << inverse_ * u * T_map_b.rotation().matrix(), 0, 0, 0;
    return true;
  }
  /// The distance and its standard deviation in the new scale.
  std::shared_ptr<const Factor> transformed(const Sim3& S_new_old) const override {
    const auto result = std::make_shared<DistanceFactor>(*this);
    result->distance_ *= S_new_old.scale();
    result->inverse_ /= S_new_old.scale();
    return result;
  }

 private:
  double distance_, inverse_;
};

}  // namespace placegraph
