#pragma once
#include <placegraph/backend/factors/factor.h>

namespace [[gnu::visibility("default")]] placegraph {

/// The error T_world_node^-1 p_world - p_node of a point [m], with its derivatives.
/// The point is treated as a pose without rotation, T_world_point = (I, p_world); the derivatives
/// are by T exp(xi) of node and point:
///
///   d e / d rho_node = -I,   d e / d phi_node = hat(e + p_node),   d e / d rho_point = R_node^T
///
/// In the plane the third component is zero. A similarity has a scale of its own: d e / d rho_point
/// is divided by it.
template <class Group>
struct PointLinearization {
  Eigen::Vector3d e = Eigen::Vector3d::Zero();  ///< error in the node's frame [m]
  /// Derivatives of the error by the tangents of the node and of the point.
  Eigen::Matrix<double, 3, Group::kDof> J_node = Eigen::Matrix<double, 3, Group::kDof>::Zero(),
                                        J_point = Eigen::Matrix<double, 3, Group::kDof>::Zero();

  /// Linearizes at a pose and a point; `p_node` is the measured position in the node's frame.
  PointLinearization(const Group& T_world_node, const Eigen::Vector3d& p_world,
                     const Eigen::Vector3d& p_node) {
    constexpr int dim = Group::kDof == 3 ? 2 : 3;
    const Eigen::Matrix<double, dim, 1> seen =
        T_world_node.inverse() * Eigen::Matrix<double, dim, 1>(p_world.head<dim>());
    e.template head<dim>() = seen - p_node.template head<dim>();
    J_node.template topLeftCorner<dim, dim>().diagonal().setConstant(-1);
    const Eigen::Matrix<double, dim, dim> R_node_world =
        T_world_node.rotation().matrix().transpose();
    J_point.template topLeftCorner<dim, dim>() = R_node_world;
    if constexpr (dim == 2) {
      J_node(0, 2) = seen[1];
      J_node(1, 2) = -seen[0];
    } else {
      J_node.template middleCols<3>(3) = hat(Eigen::Vector3d(seen));
    }
    if constexpr (Group::kDof == 7) {
      J_point.template leftCols<3>() /= T_world_node.scale();
      J_node.col(6) = -seen;
    }
  }
};

/// A measured position of a point in a node's frame: r = W e, W^T W = information.
/// e and its derivatives are those of PointLinearization.
template <class Group>
class PointInNodeFactor final
    : public SizedFactor<(Group::kDof == 3 ? 2 : 3), Group, Eigen::Vector3d> {
  static constexpr int kDim = Group::kDof == 3 ? 2 : 3;
  using Base = SizedFactor<kDim, Group, Eigen::Vector3d>;
  using Whitening = Eigen::Matrix<double, kDim, kDim>;

 public:
  /// Measured position [m] and W; in the plane W is 2x2 and z is ignored.
  PointInNodeFactor(const Eigen::Vector3d& p_node, const Whitening& whitening)
      : p_node_(p_node), W_(whitening) {}

  /// The residual and its Jacobians as above; always true.
  bool compute(const Group& T_world_node, const Eigen::Vector3d& p_world,
               typename Base::Residual& r, typename Base::Jacobians* J) const override {
    const PointLinearization<Group> at(T_world_node, p_world, p_node_);
    r.noalias() = W_ * at.e.template head<kDim>();
    if (!J) return true;
    std::get<0>(*J).noalias() = W_ * at.J_node.template topRows<kDim>();
    std::get<1>(*J).setZero();
    std::get<1>(*J).template leftCols<kDim>().noalias() =
        W_ * at.J_point.template topLeftCorner<kDim, kDim>();
    return true;
  }

 private:
  Eigen::Vector3d p_node_;
  Whitening W_;
};

}  // namespace placegraph
