#pragma once
#include <ceres/sized_cost_function.h>
#include <placegraph/backend/factors/pose_manifold.h>

namespace placegraph {

/// The position of a node [m], r = W (t_world_node - position_world), W^T W = information.
///
///   d r / d rho = W s R_world_node   (s = 1 but for Sim(3))
///
/// A node of SE(2) lies in the plane: the third component of the error is left out (zero).
template <class Group>
class PositionFactor final : public ceres::SizedCostFunction<3, PoseBlock<Group>::kSize> {
 public:
  PositionFactor(const Eigen::Vector3d& position_world, const Eigen::Matrix3d& whitening)
      : position_world_(position_world), W_(whitening) {}

  /// t_world_node - position_world
  static Eigen::Vector3d error(const Group& T_world_node, const Eigen::Vector3d& position_world) {
    constexpr int dim = Group::kDof == 3 ? 2 : 3;
    Eigen::Vector3d e = Eigen::Vector3d::Zero();
    e.template head<dim>() = T_world_node.translation() - position_world.template head<dim>();
    return e;
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    constexpr int dim = Group::kDof == 3 ? 2 : 3;
    const Group T_world_node = PoseBlock<Group>::load(parameters[0]);
    Eigen::Map<Eigen::Vector3d> r(residuals);
    r.noalias() = W_ * error(T_world_node, position_world_);
    if (!jacobians || !jacobians[0]) return true;
    Eigen::Map<Eigen::Matrix<double, 3, PoseBlock<Group>::kSize, Eigen::RowMajor>> J(jacobians[0]);
    J.setZero();
    J.template leftCols<dim>().noalias() =
        W_.template leftCols<dim>() * T_world_node.rotation().matrix();
    if constexpr (Group::kDof == 7) J.template leftCols<3>() *= T_world_node.scale();
    return true;
  }

 private:
  Eigen::Vector3d position_world_;
  Eigen::Matrix3d W_;
};

}  // namespace placegraph
