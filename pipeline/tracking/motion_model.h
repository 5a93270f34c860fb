#pragma once
#include <placegraph/graph/geometry/lie.h>

#include <optional>

namespace placegraph {

/// Constant-velocity model of the camera's motion from frame to frame.
class MotionModel {
 public:
  /// `T_last_cur`: motion over one frame; nothing while it is unknown.
  explicit MotionModel(const SE3& T_odom_cam = SE3(), const std::optional<SE3>& T_last_cur = {})
      : T_odom_cam_(T_odom_cam), T_last_cur_(T_last_cur) {}

  /// Pose of the last frame that has one.
  const SE3& T_odom_cam() const { return T_odom_cam_; }
  bool velocity_known() const { return T_last_cur_.has_value(); }
  /// Motion over one frame; identity while it is unknown.
  SE3 T_last_cur() const { return T_last_cur_.value_or(SE3()); }
  /// Predicted pose of the next frame.
  SE3 predicted() const { return T_odom_cam_ * T_last_cur(); }

  /// Updates the model with the pose of the next frame.
  void update(const SE3& T_odom_cam) {
    T_last_cur_ = T_odom_cam_.inverse() * T_odom_cam;
    T_odom_cam_ = T_odom_cam;
  }
  /// Replaces the pose of the last frame by a better estimate; the velocity is kept.
  void correct(const SE3& T_odom_cam) { T_odom_cam_ = T_odom_cam; }
  void forget_velocity() { T_last_cur_.reset(); }
  /// Multiplies the velocity by `factor` after a change of the map's scale.
  void rescale_velocity(double factor) {
    if (T_last_cur_) T_last_cur_ = T_last_cur_->scaled(factor);
  }

  /// Uncertainty of the predicted pose.
  struct Uncertainty {
    double depth_share;  ///< standard deviation of the position, as a share of the median depth ...
    double step_share;   ///< ... plus this share of the motion over one frame
    double sigma_rad;
  };
  /// Information of the predicted pose in its right tangent [translation, rotation].
  Matrix6d information(const Uncertainty& u, double median_depth) const {
    const double sigma =
        u.depth_share * median_depth + u.step_share * T_last_cur().translation().norm();
    Vector6d sigmas;
    sigmas << Eigen::Vector3d::Constant(sigma), Eigen::Vector3d::Constant(u.sigma_rad);
    return sigmas.cwiseAbs2().cwiseInverse().asDiagonal();
  }

 private:
  SE3 T_odom_cam_;
  std::optional<SE3> T_last_cur_;
};

}  // namespace placegraph
