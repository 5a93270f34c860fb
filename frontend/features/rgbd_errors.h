#pragma once
#include <placegraph/graph/geometry/camera.h>

#include <optional>

namespace placegraph {

/// Errors of an RGB-D camera against its calibration that displace pixels and depths.
///
/// Images are read row by row, from half the readout time before the frame's stamp to half of it
/// after. The depth image shows the scene at the stamp plus the depth time, displaced against it.
/// The effects of all are linear in their values.
class RgbdErrors {
 public:
  enum Parameter : Eigen::Index {
    kFocal,       ///< relative error of both focal lengths
    kPrincipalX,  ///< error of cx in units of fx
    kPrincipalY,  ///< error of cy in units of fy
    kReadout,     ///< readout time of the image [s]
    kDepthTime,   ///< time of the depth image after the frame's stamp [s]
    kDepthX,      ///< displacement of the depth image along u in focal lengths
    kDepthY,      ///< the same along v
    kParameters
  };
  using Vector = Eigen::Matrix<double, kParameters, 1>;
  /// Derivative of the observed u, v [px] and inverse depth [1/m] by the errors.
  using Derivative = Eigen::Matrix<double, 3, kParameters>;

  RgbdErrors() = default;
  explicit RgbdErrors(const Vector& values) : values_(values) {}
  const Vector& values() const { return values_; }
  bool any() const { return !values_.isZero(0); }
  void visit_state(auto& archive) { archive(values_); }

  /// Effect of the errors on the observation of a point at `p_cam` [m] at pixel `px`, if the camera
  /// moves by `twist` ([velocity m/s, rotation rad/s], right tangent). `surface_cam`: g of the
  /// plane g^T X = 1 on which the point lies; zero: the inverse depth is not affected.
  static Derivative derivative(const Camera& camera, const Eigen::Vector2d& px,
                               const Eigen::Vector3d& p_cam, const Vector6d& twist,
                               const Eigen::Vector3d& surface_cam = Eigen::Vector3d::Zero());

  /// Effect of these errors on u, v [px] and inverse depth [1/m].
  Eigen::Vector3d effect(const Camera& camera, const Eigen::Vector2d& px,
                         const Eigen::Vector3d& p_cam, const Vector6d& twist,
                         const Eigen::Vector3d& surface_cam) const {
    return derivative(camera, px, p_cam, twist, surface_cam) * values_;
  }
  /// Displacement [px] of a point at `p_cam`, observed at `px`, by the errors.
  Eigen::Vector2d displacement_px(const Camera& camera, const Eigen::Vector2d& px,
                                  const Eigen::Vector3d& p_cam, const Vector6d& twist) const;
  /// The depth camera as it stood at the time of its image, relative to the camera at the frame's.
  DepthCamera corrected(DepthCamera depth, const Vector6d& twist) const;

 private:
  Vector values_ = Vector::Zero();
};

/// The errors and the velocity of the camera at a frame, on which their effects depend.
struct FrameErrors {
  RgbdErrors errors;
  Vector6d twist = Vector6d::Zero();
};

}  // namespace placegraph
