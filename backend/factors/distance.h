#pragma once
#include <ceres/sized_cost_function.h>
#include <placegraph/backend/factors/pose_manifold.h>

namespace placegraph {

/// Distance between two cameras, in standard deviations:
///
///   r = (|t_b - t_a| - distance) / sigma,   u = (t_b - t_a) / |t_b - t_a|
///   d r / d xi_a = [-u^T R_a, 0] / sigma,   d r / d xi_b = [u^T R_b, 0] / sigma
///
/// (T exp(xi) moves the origin by R rho.) Where the two coincide the direction is undefined and the
/// derivatives are zero.
class Distance {
 public:
  Distance(double distance_m, double sigma_m) : distance_(distance_m), inverse_(1.0 / sigma_m) {}

  double residual(const SE3& T_map_a, const SE3& T_map_b,
                  Eigen::Matrix<double, 1, 6>* J_a = nullptr,
                  Eigen::Matrix<double, 1, 6>* J_b = nullptr) const {
    const Eigen::Vector3d t_a_b_map = T_map_b.translation() - T_map_a.translation();
    const double length = t_a_b_map.norm();
    const Eigen::RowVector3d u = length > 1e-12 ? Eigen::RowVector3d(t_a_b_map.transpose() / length)
                                                : Eigen::RowVector3d::Zero();
    if (J_a) *J_a << -inverse_ * u * T_map_a.rotation().matrix(), 0, 0, 0;
    if (J_b) *J_b << inverse_ * u * T_map_b.rotation().matrix(), 0, 0, 0;
    return (length - distance_) * inverse_;
  }

 private:
  double distance_, inverse_;
};

/// Distance between the blocks T_map_a and T_map_b.
class DistanceFactor final : public ceres::SizedCostFunction<1, 7, 7> {
 public:
  explicit DistanceFactor(const Distance& distance) : distance_(distance) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    Eigen::Matrix<double, 1, 6> J[2];
    residuals[0] = distance_.residual(PoseBlock<SE3>::load(parameters[0]),
                                      PoseBlock<SE3>::load(parameters[1]), &J[0], &J[1]);
    for (int k = 0; jacobians && k < 2; ++k)
      if (jacobians[k])
        Eigen::Map<Eigen::Matrix<double, 1, 7, Eigen::RowMajor>>(jacobians[k]) << J[k], 0.0;
    return true;
  }

 private:
  Distance distance_;
};

}  // namespace placegraph
