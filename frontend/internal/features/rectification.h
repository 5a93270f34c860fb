#pragma once
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/graph/core/options.h>

#include <Eigen/Core>
#include <vector>

namespace placegraph {

/// What a stereo pair that should be rectified is still off by: a measured disparity is the true
/// one plus offset + by_x x + by_y y at the ray (x, y, 1) of the left eye. To first order that is a
/// right eye turned about its vertical axis (offset), of another focal length (by_x) and turned
/// about its optical axis (by_y); a tenth of a pixel of offset moves a point at 40 baselines by
/// half a per cent of its depth.
struct RectificationError {
  double offset_px = 0, by_x_px = 0, by_y_px = 0;
  double at(const Eigen::Vector2d& ray) const {
    return offset_px + by_x_px * ray.x() + by_y_px * ray.y();
  }
};

/// A point's disparity as the two eyes show it and as the camera's motion does: f b over the depth
/// that the left eye alone triangulates from several poses.
struct DisparitySample {
  Eigen::Vector2d ray = Eigen::Vector2d::Zero();  ///< x, y of the left eye's ray, z = 1
  double measured_px = 0;
  double from_motion_px = 0;
  double sigma_px = 1;  ///< of their difference
};

/// Self-calibration of a stereo pair while it drives. The motion knows depths up to one scale,
/// which disparities of many sizes tell apart from an offset: a Kalman filter of the scale, which
/// wanders, and of the error, which does not, by measured = scale * from_motion + error(ray), each
/// batch by iteratively reweighted least squares (Cauchy). Each point should be handed over once:
/// its samples repeat the same noise.
class RectificationEstimator {
 public:
  explicit RectificationEstimator(const RectificationOptions& options);

  void add(const std::vector<DisparitySample>& samples);
  RectificationError error() const { return {state_[1], state_[2], state_[3]}; }
  /// Covariance of offset, by_x, by_y [px^2].
  Eigen::Matrix3d covariance() const { return covariance_.bottomRightCorner<3, 3>(); }

 private:
  RectificationOptions options_;
  Eigen::Vector4d state_;  // scale, offset, by_x, by_y
  Eigen::Matrix4d covariance_;
};

}  // namespace placegraph
