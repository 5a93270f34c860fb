#pragma once
#include <placegraph/backend/factors/factor.h>
#include <placegraph/backend/factors/pose_error.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A measured relative pose of two nodes: r = W e(E), W^T W = information.
/// E = T_from_to_measured^-1 T_world_from^-1 T_world_to; e and its derivatives are those of
/// RelativePoseLinearization.
template <class Group>
class RelativePoseFactor final : public SizedFactor<Group::kDof, Group, Group> {
  using Base = SizedFactor<Group::kDof, Group, Group>;

 public:
  /// The measured pose, W, and the coordinates of the error pose that W refers to.
  RelativePoseFactor(const Group& T_from_to, const typename Group::Jacobian& whitening,
                     RotationError kind = RotationError::kLog)
      : T_to_from_(T_from_to.inverse()), W_(whitening), kind_(kind) {}

  /// The residual and its Jacobians as above; always true.
  bool compute(const Group& T_world_from, const Group& T_world_to, typename Base::Residual& r,
               typename Base::Jacobians* J) const override {
    if (!J) {
      r.noalias() = W_ * pose_error(T_to_from_ * (T_world_from.inverse() * T_world_to), kind_);
      return true;
    }
    const RelativePoseLinearization<Group> at(T_to_from_, T_world_from, T_world_to, kind_);
    r.noalias() = W_ * at.e;
    std::get<0>(*J).noalias() = W_ * at.J_from;
    std::get<1>(*J).noalias() = W_ * at.J_to;
    return true;
  }
  /// The measured pose in the new scale, for SE3; null for other groups.
  std::shared_ptr<const Factor> transformed(const Sim3& S_new_old) const override {
    if constexpr (std::is_same_v<Group, SE3>) {
      const auto result = std::make_shared<RelativePoseFactor>(*this);
      result->T_to_from_ = T_to_from_.scaled(S_new_old.scale());
      result->W_.template leftCols<3>() /= S_new_old.scale();
      return result;
    } else {
      return nullptr;
    }
  }

 private:
  Group T_to_from_;
  typename Group::Jacobian W_;
  RotationError kind_;
};

}  // namespace placegraph
