#pragma once
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/graph/core/options.h>

#include <Eigen/Core>
#include <vector>

namespace placegraph {

/// Remaining error of the rectification of a stereo pair.
///
/// A measured disparity is the true one plus offset + by_x x + by_y y at the ray (x, y, 1) of the
/// left camera. To first order the right camera is rotated about its vertical axis (offset), has
/// another focal length (by_x) and is rotated about its optical axis (by_y). An offset of a tenth
/// of a pixel moves a point at 40 baselines by half a per cent of its depth.
struct RectificationError {
  double offset_px = 0, by_x_px = 0, by_y_px = 0;
  double at(const Eigen::Vector2d& ray) const {
    return offset_px + by_x_px * ray.x() + by_y_px * ray.y();
  }
};

/// A point's disparity in the stereo pair and as predicted from the camera's motion.
///
/// The prediction is f b over the depth that is triangulated by the left camera alone from several
/// poses.
struct DisparitySample {
  Eigen::Vector2d ray = Eigen::Vector2d::Zero();  ///< x, y of the left camera's ray, z = 1
  double measured_px = 0;
  double from_motion_px = 0;
  double sigma_px = 1;  ///< standard deviation of measured_px - from_motion_px
};

/// Self-calibration of a moving stereo pair.
///
/// The motion determines depths up to one scale, which disparities of different sizes separate from
/// an offset. A Kalman filter estimates the scale, a random walk, and the constant error from
/// measured = scale * from_motion + error(ray), each batch by iteratively reweighted least squares
/// (Cauchy). Each point should be added only once: its samples repeat the same noise.
class RectificationEstimator {
 public:
  explicit RectificationEstimator(const RectificationOptions& options);

  void add(const std::vector<DisparitySample>& samples);
  RectificationError error() const { return {state_[1], state_[2], state_[3]}; }
  /// Covariance of offset, by_x, by_y [px^2].
  Eigen::Matrix3d covariance() const { return covariance_.bottomRightCorner<3, 3>(); }
  void visit_state(auto& archive) { archive(state_, covariance_); }

 private:
  RectificationOptions options_;
  Eigen::Vector4d state_;  // scale, offset, by_x, by_y
  Eigen::Matrix4d covariance_;
};

}  // namespace placegraph
