#pragma once
#include <placegraph/backend/factors/factor.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A vehicle that does not slip sideways: its rear axle moves along an arc, so that its step has
/// opposite components across in the frames of start and end, in standard deviations:
///
///   r = a^T (t + R^T t + (R - R^T) l) / (2 sigma),   (R, t) = E = T_world_from^-1 T_world_to
///   d r / d xi_to   =  a^T [R + I, hat(R^T t) - R hat(l) - hat(R^T l)] / (2 sigma)
///   d r / d xi_from = -(d r / d xi_to) Ad(E^-1)
///
/// `across` a: unit vector across the wheels in the node's frame (or, for a road that does not jump
/// up, the vertical one); `lever_arm` l: the middle of the rear axle in that frame [m]; `sigma_m`
/// typically 2 to 5 % of the step.
class NonHolonomicFactor final : public SizedFactor<1, SE3, SE3> {
 public:
  NonHolonomicFactor(const Eigen::Vector3d& across, const Eigen::Vector3d& lever_arm,
                     double sigma_m)
      : weighted_(across.normalized().transpose() / (2 * sigma_m)), lever_arm_(lever_arm) {}

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
