#pragma once
#include <ceres/sized_cost_function.h>
#include <placegraph/backend/factors/pose_manifold.h>
#include <placegraph/backend/pose_graph_optimizer.h>

namespace placegraph {

/// The error pose E = T_from_to^-1 T_world_from^-1 T_world_to in coordinates, and its derivative by
/// E exp(xi), exact at any size of the error.
///
///   kLog:        e = log(E),                d e / d xi = right_jacobian_inverse(e)
///   kQuaternion: e = [t_E, v_E, (log s_E)], with the quaternion's sign such that w_E >= 0,
///                d t_E / d rho = s_E R_E,   d v_E / d phi = (w_E I + hat(v_E)) / 2;
///                in the plane e = [t_E, angle_E], as g2o's EDGE_SE2 has it
template <class Group>
typename Group::Tangent pose_error(const Group& E, RotationError kind,
                                   typename Group::Jacobian* J_e_xi = nullptr) {
  if (kind == RotationError::kLog) {
    const typename Group::Tangent e = E.log();
    if (J_e_xi) *J_e_xi = Group::right_jacobian_inverse(e);
    return e;
  }
  typename Group::Tangent e;
  constexpr int dim = Group::kDof == 3 ? 2 : 3;
  e.template head<dim>() = E.translation();
  if (J_e_xi) {
    J_e_xi->setZero();
    J_e_xi->template topLeftCorner<dim, dim>() = E.rotation().matrix();
  }
  if constexpr (Group::kDof == 3) {
    e[2] = E.rotation().angle();
    if (J_e_xi) (*J_e_xi)(2, 2) = 1.0;
  } else {
    Eigen::Quaterniond q = E.rotation().quaternion();
    if (q.w() < 0) q.coeffs() = -q.coeffs();
    e.template segment<3>(3) = q.vec();
    if (J_e_xi) {
      J_e_xi->template block<3, 3>(3, 3) =
          0.5 * (q.w() * Eigen::Matrix3d::Identity() + hat(q.vec()));
    }
    if constexpr (Group::kDof == 7) {
      e[6] = std::log(E.scale());
      if (J_e_xi) {
        J_e_xi->template topLeftCorner<3, 3>() *= E.scale();
        (*J_e_xi)(6, 6) = 1.0;
      }
    }
  }
  return e;
}

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
