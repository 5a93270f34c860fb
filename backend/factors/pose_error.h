#pragma once
#include <placegraph/graph/geometry/lie.h>
#include <placegraph/graph/pose_graph/constraint.h>

namespace [[gnu::visibility("default")]] placegraph {

/// The coordinates e of an error pose E, and their derivative by E exp(xi).
/// E = T_from_to^-1 T_world_from^-1 T_world_to for a relative pose. The derivative is exact for
/// errors of any size.
///
///   kLog:        e = log(E),                d e / d xi = right_jacobian_inverse(e)
///   kQuaternion: e = [t_E, v_E, (log s_E)], with the quaternion's sign such that w_E >= 0,
///                d t_E / d rho = s_E R_E,   d v_E / d phi = (w_E I + hat(v_E)) / 2;
///                in the plane e = [t_E, angle_E], as in g2o's EDGE_SE2
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

/// The error e(E) of a relative pose, and its derivatives by the tangents of both poses:
///
///   d e / d xi_to   =  d e / d xi
///   d e / d xi_from = -d e / d xi Ad((T_world_from^-1 T_world_to)^-1)
template <class Group>
struct RelativePoseLinearization {
  typename Group::Tangent e;              ///< error, see pose_error
  typename Group::Jacobian J_from, J_to;  ///< derivatives of e by the tangents of the two poses

  /// Linearizes at two poses; T_to_from_measured is the inverse of the measured T_from_to.
  RelativePoseLinearization(const Group& T_to_from_measured, const Group& T_world_from,
                            const Group& T_world_to, RotationError kind) {
    const Group T_from_to = T_world_from.inverse() * T_world_to;
    e = pose_error(T_to_from_measured * T_from_to, kind, &J_to);
    J_from.noalias() = -J_to * T_from_to.inverse().adjoint();
  }
};

}  // namespace placegraph
