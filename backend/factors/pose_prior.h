#pragma once
#include <placegraph/backend/factors/factor.h>
#include <placegraph/backend/factors/pose_error.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A measured pose: r = W e(E), E = T_world_node_measured^-1 T_world_node.
/// W^T W = information of any rank; d r / d xi = W d e / d xi, see pose_error.
template <class Group>
class PosePriorFactor final : public SizedFactor<Group::kDof, Group> {
  using Base = SizedFactor<Group::kDof, Group>;

 public:
  /// The measured pose, W, and the coordinates of the error pose that W refers to.
  PosePriorFactor(const Group& T_world_node, const typename Group::Jacobian& whitening,
                  RotationError kind = RotationError::kLog)
      : T_node_world_(T_world_node.inverse()), W_(whitening), kind_(kind) {}

  /// The residual and its Jacobian as above; always true.
  bool compute(const Group& T_world_node, typename Base::Residual& r,
               typename Base::Jacobians* J) const override {
    typename Group::Jacobian J_e_xi;
    r.noalias() = W_ * pose_error(T_node_world_ * T_world_node, kind_, J ? &J_e_xi : nullptr);
    if (J) std::get<0>(*J).noalias() = W_ * J_e_xi;
    return true;
  }
  /// The measured pose in the new frame and scale, for SE3; null for other groups.
  std::shared_ptr<const Factor> transformed(const Sim3& S_new_old) const override {
    if constexpr (std::is_same_v<Group, SE3>) {
      const SE3 T_old_node = T_node_world_.inverse();
      const auto result = std::make_shared<PosePriorFactor>(*this);
      result->T_node_world_ =
          SE3(S_new_old.rotation() * T_old_node.rotation(), S_new_old * T_old_node.translation())
              .inverse();
      result->W_.template leftCols<3>() /= S_new_old.scale();
      return result;
    } else {
      return nullptr;
    }
  }

 private:
  Group T_node_world_;
  typename Group::Jacobian W_;
  RotationError kind_;
};

}  // namespace placegraph
