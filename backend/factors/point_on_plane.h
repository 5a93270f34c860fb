#pragma once
#include <placegraph/backend/factors/factor.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A point on a plane: its distance from the plane, in standard deviations:
///
///   r = (n^T p - d) / sigma,   d r / d p = n^T / sigma,   d r / d w: see Plane3::distance_to
class PointOnPlaneFactor final : public SizedFactor<1, Eigen::Vector3d, Plane3> {
 public:
  /// Standard deviation of the distance from the plane [m], which must be positive.
  explicit PointOnPlaneFactor(double sigma_m) : inverse_sigma_(1.0 / sigma_m) {}

  /// The residual and its Jacobians as above; always true.
  bool compute(const Eigen::Vector3d& p, const Plane3& plane, Residual& r,
               Jacobians* J) const override {
    Eigen::RowVector3d J_plane;
    r[0] = inverse_sigma_ * plane.distance_to(p, J ? &J_plane : nullptr);
    if (!J) return true;
    std::get<0>(*J) = inverse_sigma_ * plane.normal().transpose();
    std::get<1>(*J) = inverse_sigma_ * J_plane;
    return true;
  }

 private:
  double inverse_sigma_;
};

}  // namespace placegraph
