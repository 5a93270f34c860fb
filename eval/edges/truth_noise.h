#pragma once
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Disagreement of a vehicle's direction of motion with its heading.
/// Wheels roll along the vehicle, so that what is left of the angle between both is noise of the
/// true heading or position.
struct DirectionNoise {
  int frames = 1;  ///< frames over which the direction is taken
  double lateral_rad = 0, vertical_rad = 0;
};

/// Frames of a trajectory, the first and the last included.
struct FrameStretch {
  int first = 0, last = 0;
};

/// Noise of the poses of a true trajectory.
struct TruthNoise {
  Outcome outcome = Outcome::ok();  ///< failure: the trajectory allows no estimate
  /// White noise of each pose, in the right tangent: standard deviations [m, rad].
  Vector6d sigma = Vector6d::Zero();
  /// That of wheeled vehicles, by ascending number of frames; empty for other motions.
  std::vector<DirectionNoise> direction;
  /// Axes of the body about which the direction of motion errs laterally and vertically.
  Eigen::Vector3d lateral_about = Eigen::Vector3d::UnitY();
  Eigen::Vector3d vertical_about = Eigen::Vector3d::UnitX();
  /// Stretches whose poses were interpolated, not measured.
  std::vector<FrameStretch> interpolated;

  /// The noise of poses that err by `position_m` along each axis and `rotation_rad` about each.
  static TruthNoise white(double position_m, double rotation_rad);

  bool is_interpolated(int frame) const;
  /// Covariance of the error of the true pose of a frame relative to another, `frames` later or
  /// earlier, in the right tangent of `T_from_to`.
  Matrix6d covariance(const SE3& T_from_to, int frames) const;
};

/// Estimates the noise of a trajectory from its poses alone.
///
/// White noise: fourth differences of the positions and third ones of the relative rotations, in
/// which smooth motion cancels (Förstner and Wrobel 2016, ch. 2), in windows of twenty poses; the
/// quarter of the windows that moves most smoothly decides. Motion that is not smooth makes it
/// larger, never smaller. Interpolated: five or more steps whose rotations are equal to a fiftieth
/// of what they usually change by, in a trajectory whose noise shows. Steps are between consecutive
/// frames, and a lost frame separates; stamps are not used.
TruthNoise estimate_truth_noise(const Trajectory& trajectory);

}  // namespace placegraph
