#pragma once
#include <placegraph/backend/factors/factor.h>
#include <placegraph/backend/factors/point_in_camera.h>
#include <placegraph/graph/geometry/camera.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Distances of the ends of an observed line segment from the projected line.
/// The distances are signed, in standard deviations, for an undistorted pinhole camera:
///
///   l = K_line m_c,   K_line = det(K) K^-T,   [m_cam, v_cam] = the line in the camera frame
///   m_c = m_cam - c x v_cam,   c = centre of the observing camera in the camera frame
///   r = [p_start^T l, p_end^T l] / (sqrt(l_1^2 + l_2^2) sigma),   p = [u, v, 1]
///   d r_i / d l = (p_i - (p_i^T l) [l_1, l_2, 0] / (l_1^2 + l_2^2)) / (sqrt(l_1^2 + l_2^2) sigma)
///   d m_cam / d xi = [hat(v_cam), hat(m_cam)],   d v_cam / d xi = [0, hat(v_cam)],
///   d [m_cam, v_cam] / d line: see transform_to
///
/// The observing camera has the orientation of the camera frame: c = 0 for the camera itself,
/// [baseline, 0, 0] for the right camera of a stereo pair. The ends measure only the line's
/// position across its direction. If the plane through the line and the camera centre is parallel
/// to the image, the line has no image: the residual is kUnprojectableResidual and the derivatives
/// are zero.
class LineReprojectionFactor final : public SizedFactor<2, SE3, Line3> {
 public:
  /// Intrinsics (distortion is ignored), both ends and their standard deviation [px], c [m].
  LineReprojectionFactor(const Camera& camera, const Eigen::Vector2d& start_px,
                         const Eigen::Vector2d& end_px, double sigma_px,
                         const Eigen::Vector3d& second_in_cam = Eigen::Vector3d::Zero())
      : inverse_sigma_(1.0 / sigma_px), hat_second_(hat(second_in_cam)) {
    K_line_ << camera.fy, 0, 0,  //
        0, camera.fx, 0,         //
        -camera.fy * camera.cx, -camera.fx * camera.cy, camera.fx * camera.fy;
    ends_ << start_px.transpose(), 1, end_px.transpose(), 1;
  }

  /// The residual and its Jacobians as above; always true.
  bool compute(const SE3& T_map_cam, const Line3& line_map, Residual& r,
               Jacobians* J) const override {
    return compute(T_map_cam, line_map, T_map_cam, r, J);
  }

  /// The residual at `T_map_cam` with derivatives at `T_map_cam_lin`.
  bool compute(const SE3& T_map_cam, const Line3& line_map, const SE3& T_map_cam_lin, Residual& r,
               Jacobians* J) const {
    const Eigen::Vector3d l = K_line_ * in_second(transform_to(T_map_cam, line_map));
    const double length = l.head<2>().norm();
    if (length > kMinLength * l.norm())
      r = ends_ * l * (inverse_sigma_ / length);
    else
      r << kUnprojectableResidual, 0;
    if (!J) return true;
    Eigen::Matrix<double, 6, 6> J_pose;
    Eigen::Matrix<double, 6, 4> J_line;
    const Eigen::Vector3d l_lin =
        K_line_ * in_second(transform_to(T_map_cam_lin, line_map, &J_pose, &J_line));
    const double length_lin = l_lin.head<2>().norm();
    Eigen::Matrix<double, 2, 3> J_l = Eigen::Matrix<double, 2, 3>::Zero();
    if (length > kMinLength * l.norm() && length_lin > kMinLength * l_lin.norm()) {
      const Eigen::RowVector3d across(l_lin[0], l_lin[1], 0);
      J_l = (ends_ - ends_ * l_lin * across / (length_lin * length_lin)) *
            (inverse_sigma_ / length_lin);
    }
    const Eigen::Matrix<double, 2, 3> J_m = J_l * K_line_;
    std::get<0>(*J).noalias() = J_m * (J_pose.topRows<3>() - hat_second_ * J_pose.bottomRows<3>());
    std::get<1>(*J).noalias() = J_m * (J_line.topRows<3>() - hat_second_ * J_line.bottomRows<3>());
    return true;
  }

 private:
  static constexpr double kMinLength = 1e-9;
  Eigen::Vector3d in_second(const Line3::Coordinates& L_cam) const {
    return L_cam.head<3>() - hat_second_ * L_cam.tail<3>();
  }
  double inverse_sigma_;
  Eigen::Matrix3d hat_second_;
  Eigen::Matrix3d K_line_;
  Eigen::Matrix<double, 2, 3> ends_;
};

}  // namespace placegraph
