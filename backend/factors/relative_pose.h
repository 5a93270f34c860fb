#pragma once
#include <ceres/sized_cost_function.h>
#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/backend/factors/pose_manifold.h>

namespace placegraph {

/// r = W e(E), W^T W = information; blocks T_world_from and T_world_to.
///
///   d r / d xi_to   =  W d e / d xi
///   d r / d xi_from = -W d e / d xi Ad((T_world_from^-1 T_world_to)^-1)
template <class Group>
class RelativePoseFactor final
    : public ceres::SizedCostFunction<Group::kDof, PoseBlock<Group>::kSize,
                                      PoseBlock<Group>::kSize> {
 public:
  using Jacobian = typename Group::Jacobian;

  RelativePoseFactor(const Group& T_from_to, const Jacobian& whitening, RotationError kind)
      : T_to_from_(T_from_to.inverse()), W_(whitening), kind_(kind) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    using Block = PoseBlock<Group>;
    constexpr int dof = Group::kDof;
    const Group T_from_to = Block::load(parameters[0]).inverse() * Block::load(parameters[1]);
    Jacobian J_e_xi;
    Eigen::Map<typename Group::Tangent> r(residuals);
    r.noalias() = W_ * pose_error(T_to_from_ * T_from_to, kind_, jacobians ? &J_e_xi : nullptr);
    if (!jacobians) return true;
    const Jacobian J_to = W_ * J_e_xi;
    using Map = Eigen::Map<Eigen::Matrix<double, dof, Block::kSize, Eigen::RowMajor>>;
    if (jacobians[0]) {
      Map J(jacobians[0]);
      J.setZero();
      J.template leftCols<dof>().noalias() = -J_to * T_from_to.inverse().adjoint();
    }
    if (jacobians[1]) {
      Map J(jacobians[1]);
      J.setZero();
      J.template leftCols<dof>() = J_to;
    }
    return true;
  }

 private:
  Group T_to_from_;
  Jacobian W_;
  RotationError kind_;
};

}  // namespace placegraph
