#pragma once
#include <placegraph/backend/factors/factor.h>
#include <placegraph/backend/factors/position_error.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A measured position of a point fixed to a node, see PositionConstraint: r = W e.
/// W^T W = information; e and its derivative are those of PositionLinearization.
template <class Group>
class PositionFactor final : public SizedFactor<3, Group> {
  using Base = SizedFactor<3, Group>;

 public:
  /// Measured position and lever arm [m], and W [1/m].
  PositionFactor(const Eigen::Vector3d& position_world, const Eigen::Vector3d& lever_arm,
                 const Eigen::Matrix3d& whitening)
      : position_world_(position_world), lever_arm_(lever_arm), W_(whitening) {}

  /// The residual and its Jacobian as above; always true.
  bool compute(const Group& T_world_node, typename Base::Residual& r,
               typename Base::Jacobians* J) const override {
    const PositionLinearization<Group> at(T_world_node, lever_arm_, position_world_);
    r.noalias() = W_ * at.e;
    if (J) std::get<0>(*J).noalias() = W_ * at.J;
    return true;
  }

 private:
  Eigen::Vector3d position_world_, lever_arm_;
  Eigen::Matrix3d W_;
};

}  // namespace placegraph
