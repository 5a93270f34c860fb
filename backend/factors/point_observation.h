#pragma once
#include <placegraph/backend/factors/factor.h>
#include <placegraph/backend/factors/inverse_depth.h>
#include <placegraph/backend/factors/point_in_camera.h>
#include <placegraph/backend/factors/reprojection.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A measurement of a point in a camera as a factor of T_world_cam and p_world.
/// `Measurement` (Reprojection, InverseDepth) computes r and A = d r / d p_cam, PointInCamera the
/// other derivatives. For a point that cannot be projected the residual is kUnprojectableResidual
/// and the derivatives are zero.
template <class Measurement>
class PointObservationFactor final : public SizedFactor<Measurement::kRows, SE3, Eigen::Vector3d> {
  using Base = SizedFactor<Measurement::kRows, SE3, Eigen::Vector3d>;

 public:
  /// Creates the factor of a measurement, which is copied.
  explicit PointObservationFactor(const Measurement& measurement) : measurement_(measurement) {}

  /// The residual and its Jacobians as above; always true.
  bool compute(const SE3& T_world_cam, const Eigen::Vector3d& p_world, typename Base::Residual& r,
               typename Base::Jacobians* J) const override {
    const Eigen::Matrix3d R_world_cam = T_world_cam.rotation().matrix();
    const PointInCamera point(R_world_cam, T_world_cam.translation(), p_world);
    const bool projectable = point.projectable();
    r.setZero();
    if (projectable)
      r = measurement_.residual(point.p_cam);
    else
      r[0] = kUnprojectableResidual;
    if (!J) return true;
    Eigen::Matrix<double, Measurement::kRows, 3> A;
    A.setZero();
    if (projectable) A = measurement_.derivative(point.p_cam);
    std::get<0>(*J) << -A, A * hat(projectable ? point.p_cam : Eigen::Vector3d(0, 0, 0));
    std::get<1>(*J).noalias() = A * R_world_cam.transpose();
    return true;
  }

 private:
  Measurement measurement_;
};

}  // namespace placegraph
