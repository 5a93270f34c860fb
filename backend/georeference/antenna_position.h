#pragma once
#include <ceres/sized_cost_function.h>
#include <placegraph/backend/factors/position_error.h>
#include <placegraph/backend/factors/variable_manifold.h>
#include <placegraph/backend/georeference/antenna_trajectory.h>

namespace placegraph {

/// A measured position with unknown lever arm and clock offset.
/// All fixes share these unknowns, block c = [lever_arm, clock_offset]:
///
///   r = W (T_world_node * a - position_world),   a = A lever_arm + t + v clock_offset
///   d r / d xi = W d e / d xi (as PositionFactor at a),   d r / d c = W s R [A, v]
///
/// In the plane the third component of the error is left out.
template <class Group>
class AntennaPositionFactor final
    : public ceres::SizedCostFunction<3, VariableBlock<Group>::kSize, 4> {
 public:
  AntennaPositionFactor(const InterpolatedFix& fix, const Eigen::Vector3d& position_world,
                        const Eigen::Matrix3d& whitening)
      : fix_(fix), position_world_(position_world), W_(whitening) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Group T_world_node = VariableBlock<Group>::load(parameters[0]);
    const Eigen::Map<const Eigen::Vector4d> c(parameters[1]);
    const Eigen::Vector3d antenna = fix_.antenna(c.head<3>(), c[3]);
    const PositionLinearization<Group> at(T_world_node, antenna, position_world_);
    Eigen::Map<Eigen::Vector3d> r(residuals);
    r.noalias() = W_ * at.e;
    if (!jacobians) return true;
    if (jacobians[0]) {
      Eigen::Map<Eigen::Matrix<double, 3, VariableBlock<Group>::kSize, Eigen::RowMajor>> J(
          jacobians[0]);
      J.setZero();
      J.template leftCols<Group::kDof>().noalias() = W_ * at.J;
    }
    if (jacobians[1]) {
      Eigen::Matrix<double, 3, 4> J_a_c;
      J_a_c << fix_.A, fix_.v;
      Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> J(jacobians[1]);
      // The first columns of the linearization are d e / d a: a translation of the node by rho and
      // one of the antenna within the node have the same effect.
      if constexpr (Group::kDof == 3)
        J.noalias() = W_.template leftCols<2>() * at.J.template topLeftCorner<2, 2>() *
                      J_a_c.template topRows<2>();
      else
        J.noalias() = W_ * at.J.template leftCols<3>() * J_a_c;
    }
    return true;
  }

 private:
  InterpolatedFix fix_;
  Eigen::Vector3d position_world_;
  Eigen::Matrix3d W_;
};

}  // namespace placegraph
