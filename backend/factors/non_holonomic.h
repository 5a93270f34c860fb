#pragma once
#include <placegraph/backend/factors/factor.h>

namespace [[gnu::visibility("default")]] placegraph {

/// The constraint that a wheeled vehicle does not slip sideways.
/// The rear axle moves along an arc, so the translation of a step has opposite lateral components
/// in the frames of its start and its end; r is their sum in standard deviations:
///
///   r = a^T (t + R^T t + (R - R^T) l) / (2 sigma),   (R, t) = E = T_world_from^-1 T_world_to
///   d r / d xi_to   =  a^T [R + I, hat(R^T t) - R hat(l) - hat(R^T l)] / (2 sigma)
///   d r / d xi_from = -(d r / d xi_to) Ad(E^-1)
///
/// `across` a: direction across the wheels in the node's frame, of any length (or the vertical, for
/// a vehicle that stays on a smooth road); `lever_arm` l: the middle of the rear axle in that frame
/// [m]; `sigma_m` typically 2 to 5 % of the step.
class NonHolonomicFactor final : public SizedFactor<1, SE3, SE3> {
 public:
  /// a, l and the standard deviation of half the sum of the two components [m].
  NonHolonomicFactor(const Eigen::Vector3d& across, const Eigen::Vector3d& lever_arm,
                     double sigma_m)
      : weighted_(across.normalized().transpose() / (2 * sigma_m)), lever_arm_(lever_arm) {}

  /// The residual and its Jacobians as above; always true.
  bool compute(const SE3& T_world_from, const SE3& T_world_to, Residual& r,
               Jacobians* J) const override {
    const SE3 E = T_world_from.inverse() * T_world_to;
    const Eigen::Matrix3d R = E.rotation().matrix();
    const Eigen::Vector3d back = R.transpose() * (E.translation() - lever_arm_);
    r[0] = weighted_ * (E.translation() + R * lever_arm_ + back);
    if (!J) return true;
    auto& J_to = std::get<1>(*J);
    J_to << weighted_ * (R + Eigen::Matrix3d::Identity()),
        weighted_ * (hat(back) - R * hat(lever_arm_));
    std::get<0>(*J).noalias() = -J_to * E.inverse().adjoint();
    return true;
  }

 private:
  Eigen::RowVector3d weighted_;
  Eigen::Vector3d lever_arm_;
};

}  // namespace placegraph
