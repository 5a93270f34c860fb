#pragma once
#include <placegraph/backend/factors/factor.h>

#include <cmath>

namespace placegraph {

/// Reprojection error with unknown focal length and radial distortion, in standard deviations.
/// The principal point is zero, as in "Bundle Adjustment in the Large" (Agarwal et al. 2010):
///
///   r = (f d q - observed) / sigma,   q = [x/z, y/z],   d = 1 + k1 s + k2 s^2,   s = |q|^2
///   d r / d q = f (d I + 2 (k1 + 2 k2 s) q q^T) / sigma
///   d r / d [f k1 k2] = [d, f s, f s^2] q / sigma
///   d r / d xi = A [-I, hat(p_cam)],   d r / d p_world = A R_world_cam^T,   A = d r / d p_cam
///
/// Variables T_world_cam (z forward), [f, k1, k2] and p_world. As in those problems a point behind
/// its camera is projected too; only a point in the plane through the camera's centre cannot be
/// projected.
class RadialReprojectionFactor final
    : public SizedFactor<2, SE3, Eigen::Vector3d, Eigen::Vector3d> {
 public:
  RadialReprojectionFactor(const Eigen::Vector2d& px, double sigma_px)
      : px_(px), inverse_sigma_(1.0 / sigma_px) {}

  bool compute(const SE3& T_world_cam, const Eigen::Vector3d& intrinsics,
               const Eigen::Vector3d& p_world, Residual& r, Jacobians* J) const override {
    const Eigen::Matrix3d R_cam_world = T_world_cam.rotation().matrix().transpose();
    const Eigen::Vector3d p = R_cam_world * (p_world - T_world_cam.translation());
    if (!(std::abs(p[2]) > 1e-12)) return false;
    const double f = intrinsics[0], k1 = intrinsics[1], k2 = intrinsics[2];
    const Eigen::Vector2d q = p.head<2>() / p[2];
    const double s = q.squaredNorm();
    const double d = 1 + s * (k1 + k2 * s);
    r = (f * d * q - px_) * inverse_sigma_;
    if (!J) return true;
    const Eigen::Matrix2d J_q =
        f * inverse_sigma_ *
        (d * Eigen::Matrix2d::Identity() + 2 * (k1 + 2 * k2 * s) * q * q.transpose());
    Eigen::Matrix<double, 2, 3> A;
    A << J_q / p[2], -J_q * q / p[2];
    std::get<0>(*J) << -A, A * hat(p);
    std::get<1>(*J) << q * (d * inverse_sigma_), q * (f * s * inverse_sigma_),
        q * (f * s * s * inverse_sigma_);
    std::get<2>(*J).noalias() = A * R_cam_world;
    return true;
  }

 private:
  Eigen::Vector2d px_;
  double inverse_sigma_;
};

}  // namespace placegraph
