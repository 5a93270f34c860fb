#pragma once
#include <ceres/sized_cost_function.h>
#include <placegraph/backend/factors/point_in_camera.h>

namespace placegraph {

/// A measurement of a map point in a camera (Reprojection, InverseDepth) between the blocks
/// T_map_cam [qx qy qz qw x y z] and p_map [x y z]. Derivatives by the tangent of T_map_cam, see
/// VariableManifold. The residual of a point that cannot be projected is kUnprojectableResidual.
template <class Measurement>
class PointFactor final : public ceres::SizedCostFunction<Measurement::kRows, 7, 3> {
 public:
  explicit PointFactor(const Measurement& measurement) : measurement_(measurement) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    constexpr int rows = Measurement::kRows;
    Eigen::Matrix3d R_map_cam;
    const PointInCamera point(parameters[0], parameters[1], R_map_cam);
    Eigen::Map<Eigen::Matrix<double, rows, 1>> r(residuals);
    const bool projectable = point.projectable();
    if (projectable) {
      r = measurement_.residual(point.p_cam);
    } else {
      r.setZero();
      r[0] = kUnprojectableResidual;
    }
    if (!jacobians) return true;
    Eigen::Matrix<double, rows, 3> A = Eigen::Matrix<double, rows, 3>::Zero();
    if (projectable) A = measurement_.derivative(point.p_cam);
    if (jacobians[0]) {
      const Eigen::Vector3d& p = point.p_cam;
      Eigen::Map<Eigen::Matrix<double, rows, 7, Eigen::RowMajor>> J(jacobians[0]);
      for (int i = 0; i < rows; ++i) {
        J(i, 0) = -A(i, 0);
        J(i, 1) = -A(i, 1);
        J(i, 2) = -A(i, 2);
        J(i, 3) = projectable ? A(i, 1) * p[2] - A(i, 2) * p[1] : 0.0;
        J(i, 4) = projectable ? A(i, 2) * p[0] - A(i, 0) * p[2] : 0.0;
        J(i, 5) = projectable ? A(i, 0) * p[1] - A(i, 1) * p[0] : 0.0;
        J(i, 6) = 0.0;
      }
    }
    if (jacobians[1]) {
      Eigen::Map<Eigen::Matrix<double, rows, 3, Eigen::RowMajor>> J(jacobians[1]);
      J.noalias() = A * R_map_cam.transpose();
    }
    return true;
  }

 private:
  Measurement measurement_;
};

}  // namespace placegraph
