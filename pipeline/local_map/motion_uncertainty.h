#pragma once
#include <placegraph/backend/evidence/motion_errors.h>
#include <placegraph/pipeline/local_map/stamp_jitter.h>

#include <vector>

namespace placegraph {

/// Errors of a motion by the imaging errors and, in the last column, by the stated length.
using SharedErrors = Eigen::Matrix<double, 6, ImagingErrors::kParameters + 1>;

/// What the uncertainty of a motion consists of, in the right tangent of T_from_to.
struct AssessedMotion {
  Matrix6d stated = Matrix6d::Zero();  ///< covariance by the stated noise of the observations
  /// Covariance by the noise of the observations, as large as their residuals scatter.
  Matrix6d by_observations = Matrix6d::Zero();
  /// Standard deviations by the length on which the scale rests; zero where nothing measures it.
  Vector6d by_length = Vector6d::Zero();
  /// Covariance by stamps with a standard deviation of one second.
  Matrix6d by_stamps = Matrix6d::Zero();
  /// Derivative of the motion's error by the imaging errors.
  Eigen::Matrix<double, 6, ImagingErrors::kParameters> by_imaging_errors =
      decltype(by_imaging_errors)::Zero();

  /// The same with all lengths multiplied by `factor`.
  AssessedMotion scaled(double factor) const;
};

/// The motion between two keyframes of a window; `stated`: its covariance by the stated noise of
/// the observations. `metric`: whether lengths are measured; else the length of the motion is taken
/// as known.
AssessedMotion assess_motion(const SlidingWindow& window, KeyframeId from, KeyframeId to,
                             const Matrix6d& stated, bool metric);

/// Uncertainty of the motions of an odometry beyond the stated noise of its observations: the
/// correlation of errors along tracks, errors of the calibration and of a rolling shutter, of the
/// length on which the scale rests, and of the stamps. A run learns them from its own residuals.
class MotionUncertainty {
 public:
  /// Adds the evidence of a window that shares no keyframe with the ones before.
  void add_window(const SlidingWindow& window);
  /// Adds the pose of a frame, in the order of the stamps.
  void add_frame(std::int64_t stamp_ns, const SE3& T_odom_cam);
  /// The next frame belongs to another track.
  void restart() { jitter_.restart(); }

  /// Covariance of a motion by all that has been learned until now.
  Matrix6d covariance(const AssessedMotion& motion) const;
  /// The part of it that each motion has of its own, and a root of the other part, whose columns
  /// are the same errors for all motions.
  Matrix6d independent_covariance(const AssessedMotion& motion) const;
  SharedErrors by_shared_errors(const AssessedMotion& motion) const;
  /// Mean of q q^T of the imaging errors q: a prior about zero and the evidence of all windows,
  /// which counts less if the windows contradict each other.
  const ImagingErrors::Matrix& imaging_errors() const { return second_moment_; }
  void visit_state(auto& archive) { archive(windows_, second_moment_, dispersion_, jitter_); }

 private:
  std::vector<NuisanceEvidence> windows_;
  ImagingErrors::Matrix second_moment_ = prior();
  double dispersion_ = 1;  // mean square of the windows' contradictions in sigmas, at least 1
  StampJitter jitter_;

  static ImagingErrors::Matrix prior();
};

}  // namespace placegraph
