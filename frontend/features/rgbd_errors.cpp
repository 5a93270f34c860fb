#include <placegraph/frontend/features/rgbd_errors.h>

namespace placegraph {

RgbdErrors::Derivative RgbdErrors::derivative(const Camera& camera, const Eigen::Vector2d& px,
                                              const Eigen::Vector3d& p_cam, const Vector6d& twist,
                                              const Eigen::Vector3d& surface_cam) {
  Derivative J = Derivative::Zero();
  const Eigen::Vector2d f(camera.fx, camera.fy), x = p_cam.head<2>() / p_cam.z();
  // Velocity of the camera at the point; the point moves in the camera against it.
  const Eigen::Vector3d moved = twist.head<3>() + twist.tail<3>().cross(p_cam);
  const Eigen::Vector2d flow_px = -f.cwiseProduct(moved.head<2>() - x * moved.z()) / p_cam.z();
  const double row = (px.y() - 0.5 * (camera.height - 1)) / camera.height;
  J.block<2, 1>(0, kFocal) = f.cwiseProduct(x);
  J(0, kPrincipalX) = f.x();
  J(1, kPrincipalY) = f.y();
  J.block<2, 1>(0, kReadout) = row * flow_px;
  if (surface_cam.isZero(0)) return J;
  // The depth is read at the displaced pixel, from a surface that has moved against the camera.
  J.row(2) = surface_cam.head<2>().cwiseQuotient(f).transpose() * J.topRows<2>();
  J(2, kDepthTime) = surface_cam.dot(moved) / p_cam.z();
  J.block<1, 2>(2, kDepthX) = -surface_cam.head<2>().transpose();
  return J;
}

Eigen::Vector2d RgbdErrors::displacement_px(const Camera& camera, const Eigen::Vector2d& px,
                                            const Eigen::Vector3d& p_cam,
                                            const Vector6d& twist) const {
  return derivative(camera, px, p_cam, twist).topRows<2>() * values_;
}

DepthCamera RgbdErrors::corrected(DepthCamera depth, const Vector6d& twist) const {
  const Eigen::Vector3d displaced = depth.T_cam_depth.rotation().inverse() *
                                    Eigen::Vector3d(values_[kDepthX], values_[kDepthY], 0);
  depth.camera.cx += displaced.x() * depth.camera.fx;
  depth.camera.cy += displaced.y() * depth.camera.fy;
  const SE3 T_cam_then = SE3::exp(values_[kDepthTime] * twist);
  depth.T_cam_depth = T_cam_then * depth.T_cam_depth;
  return depth;
}

}  // namespace placegraph
