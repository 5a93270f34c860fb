#pragma once
#include <placegraph/backend/factors/factor.h>
#include <placegraph/backend/factors/point_in_camera.h>
#include <placegraph/backend/factors/reprojection.h>

namespace placegraph {

/// The four corners of a square marker in an undistorted pinhole camera, in standard deviations.
/// Seen from the front they are clockwise from the upper left one: c = size / 2 [-1 1 0], [1 1 0],
/// [1 -1 0], [-1 -1 0] in the marker's frame:
///
///   r_k = Reprojection of R_w_m c_k + t_w_m,   A_k = d r_k / d p_cam
///   d r_k / d xi_cam = A_k [-I, hat(p_cam)],   d r_k / d xi_marker = A_k R_cam_marker [I, -hat(c)]
///
/// A corner that cannot be projected has the residual kUnprojectableResidual and zero derivatives.
class MarkerCornersFactor final : public SizedFactor<8, SE3, Marker> {
 public:
  using Corners = std::array<Eigen::Vector2d, 4>;

  MarkerCornersFactor(const Camera& camera, const Corners& corners_px, double sigma_px)
      : reprojections_{{{camera, corners_px[0], sigma_px},
                        {camera, corners_px[1], sigma_px},
                        {camera, corners_px[2], sigma_px},
                        {camera, corners_px[3], sigma_px}}} {}

  /// The corners in the marker's frame [m].
  static std::array<Eigen::Vector3d, 4> corners(double size_m) {
    const double h = 0.5 * size_m;
    return {{{-h, h, 0}, {h, h, 0}, {h, -h, 0}, {-h, -h, 0}}};
  }

  bool compute(const SE3& T_world_cam, const Marker& marker, Residual& r,
               Jacobians* J) const override {
    const Eigen::Matrix3d R_world_cam = T_world_cam.rotation().matrix();
    const Eigen::Matrix3d R_cam_marker =
        R_world_cam.transpose() * marker.T_world_marker.rotation().matrix();
    const auto corners_marker = corners(marker.size_m);
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector3d& c = corners_marker[static_cast<std::size_t>(k)];
      const Reprojection& reprojection = reprojections_[static_cast<std::size_t>(k)];
      const PointInCamera point(R_world_cam, T_world_cam.translation(), marker.T_world_marker * c);
      const bool projectable = point.projectable();
      if (projectable)
        r.segment<2>(2 * k) = reprojection.residual(point.p_cam);
      else
        r.segment<2>(2 * k) << kUnprojectableResidual, 0;
      if (!J) continue;
      auto J_cam = std::get<0>(*J).middleRows<2>(2 * k);
      auto J_marker = std::get<1>(*J).middleRows<2>(2 * k);
      J_cam.setZero();
      J_marker.setZero();
      if (!projectable) continue;
      const Eigen::Matrix<double, 2, 3> A = reprojection.derivative(point.p_cam);
      const Eigen::Matrix<double, 2, 3> B = A * R_cam_marker;
      J_cam << -A, A * hat(point.p_cam);
      J_marker << B, -B * hat(c);
    }
    return true;
  }

 private:
  std::array<Reprojection, 4> reprojections_;
};

}  // namespace placegraph
