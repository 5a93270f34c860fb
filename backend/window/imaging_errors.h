#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/se3.h>

#include <Eigen/Core>
#include <optional>

namespace placegraph {

/// Errors that all images of a recording share: nuisance parameters of the motion, which the
/// residuals of a short stretch hardly show. x = X/Z and y = Y/Z of a point in the camera,
/// r^2 = x^2 + y^2:
///
///   u = cx + fx (1 + s + a/2) (c + (1 + k1 r^2) x),   likewise v with 1 + s - a/2 and d
///   inverse depth = (1 + s) / Z + o from disparities, 1 / Z + o from a depth camera
///
/// and the row v of an image is exposed (v / (height - 1) - 1/2) t after its stamp.
struct ImagingErrors {
  enum Parameter : Eigen::Index {
    kFocal,         ///< s: relative error of both focal lengths
    kAspect,        ///< a: relative error of fx / fy
    kPrincipalX,    ///< c: error of cx in units of fx
    kPrincipalY,    ///< d: error of cy in units of fy
    kRadial,        ///< k1: radial distortion that is not removed
    kInverseDepth,  ///< o: offset of measured inverse depths [1/m]
    kReadout,       ///< t: time from the first row to the last [s]
    kParameters
  };
  using Vector = Eigen::Matrix<double, kParameters, 1>;
  using Matrix = Eigen::Matrix<double, kParameters, kParameters>;
  using Rows2 = Eigen::Matrix<double, 2, kParameters>;
  using Rows3 = Eigen::Matrix<double, 3, kParameters>;
};

/// Derivative of the pixel [px] (two rows) and the inverse depth [1/m] of a point by the errors.
/// `velocity`: twist of the camera [m/s, rad/s] in its own frame; without one the last column is
/// zero. `disparities`: whether inverse depths come from disparities.
inline ImagingErrors::Rows3 derivative_by_imaging_errors(const Camera& camera,
                                                         const Eigen::Vector3d& p_cam,
                                                         const std::optional<Vector6d>& velocity,
                                                         bool disparities) {
  using E = ImagingErrors;
  const double inverse_depth = 1 / p_cam.z();
  const Eigen::Vector2d x = inverse_depth * p_cam.head<2>(), f(camera.fx, camera.fy);
  E::Rows3 J = E::Rows3::Zero();
  J.col(E::kFocal) << f.cwiseProduct(x), disparities ? inverse_depth : 0;
  J.col(E::kAspect) << 0.5 * f[0] * x[0], -0.5 * f[1] * x[1], disparities ? 0.5 * inverse_depth : 0;
  J(0, E::kPrincipalX) = f[0];
  J(1, E::kPrincipalY) = f[1];
  J.col(E::kRadial).head<2>() = x.squaredNorm() * f.cwiseProduct(x);
  J(2, E::kInverseDepth) = 1;
  if (!velocity) return J;
  const double row = camera.cy + f[1] * x[1];
  const Eigen::Vector3d p_dot = -velocity->head<3>() - velocity->tail<3>().cross(p_cam);
  const Eigen::Vector2d x_dot = inverse_depth * (p_dot.head<2>() - p_dot.z() * x);
  J.col(E::kReadout) << f.cwiseProduct(x_dot), -inverse_depth * inverse_depth * p_dot.z();
  J.col(E::kReadout) *= row / (camera.height - 1) - 0.5;
  return J;
}

}  // namespace placegraph
