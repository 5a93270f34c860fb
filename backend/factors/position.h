#pragma once
#include <ceres/sized_cost_function.h>
#include <placegraph/backend/factors/pose_manifold.h>
#include <placegraph/backend/factors/position_error.h>

namespace placegraph {

/// r = W e, W^T W = information, of a PositionConstraint.
template <class Group>
class PositionFactor final : public ceres::SizedCostFunction<3, PoseBlock<Group>::kSize> {
 public:
  PositionFactor(const Eigen::Vector3d& position_world, const Eigen::Vector3d& lever_arm,
                 const Eigen::Matrix3d& whitening)
      : position_world_(position_world), lever_arm_(lever_arm), W_(whitening) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const PositionLinearization<Group> at(PoseBlock<Group>::load(parameters[0]), lever_arm_,
                                          position_world_);
    Eigen::Map<Eigen::Vector3d> r(residuals);
    r.noalias() = W_ * at.e;
    if (!jacobians || !jacobians[0]) return true;
    Eigen::Map<Eigen::Matrix<double, 3, PoseBlock<Group>::kSize, Eigen::RowMajor>> J(jacobians[0]);
    J.setZero();
    J.template leftCols<Group::kDof>().noalias() = W_ * at.J;
    return true;
  }

 private:
  Eigen::Vector3d position_world_, lever_arm_;
  Eigen::Matrix3d W_;
};

}  // namespace placegraph
