#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

/// A body's motion between two times, measured by wheels, a laser or inertial sensors.
struct MotionStep {
  std::int64_t from_ns = 0, to_ns = 0;  ///< begin and end, from_ns < to_ns
  SE3 T_from_to;                        ///< pose of the body at the end, in its frame at the begin
  Matrix6d covariance = Matrix6d::Zero();  ///< covariance of T_from_to in its right tangent
};

/// Standard deviations of motion measurements that have no covariance of their own.
/// The noise is a random walk: variances grow with the path length.
struct MotionNoise {
  double translation = 0.03;    ///< standard deviation of each coordinate after 1 m of path [m]
  double rotation_deg = 0.3;    ///< standard deviation about each axis after 1 m of path [deg]
  double translation_m = 1e-3;  ///< standard deviation of each coordinate that every step adds [m]
  /// Standard deviation about each axis that every step adds [deg].
  double rotation_step_deg = 0.01;
  void check() const;
  /// Covariance of one step in its right tangent; diagonal.
  Matrix6d covariance(const SE3& T_from_to) const;
};
void visit(OptionVisitor& field, MotionNoise& options);

/// A body's motion over time in consecutive steps.
class MeasuredMotion {
 public:
  /// The motion of steps in time order; gaps between steps are allowed.
  /// Throws ArgumentError if there is no step, or if a step takes no time, begins before the end of
  /// the previous step or is not finite.
  explicit MeasuredMotion(std::vector<MotionStep> steps);
  /// The motion between the poses of a trajectory, with covariances by `noise`.
  /// Its steps join consecutive frames that both have a pose. Throws as above.
  MeasuredMotion(const Trajectory& trajectory, const MotionNoise& noise);

  /// The motion between two times.
  struct Motion {
    SE3 T_a_b;                               ///< pose of the body at time b, in its frame at time a
    Matrix6d covariance = Matrix6d::Zero();  ///< covariance of T_a_b in its right tangent
  };
  /// The motion from one time to a later one; identity with covariance zero if they are equal.
  /// Steps are chained. The first and the last one may be used in part: as a screw motion of
  /// constant speed, with a covariance in proportion to its share of the time. Nothing if b is
  /// before a, outside the recording or across a gap.
  std::optional<Motion> between(std::int64_t a_ns, std::int64_t b_ns) const;
  /// The motion of another frame that is rigidly attached to the body, with its covariances.
  MeasuredMotion seen_from(const SE3& T_other_body) const;

  /// The steps in time order.
  const std::vector<MotionStep>& steps() const { return steps_; }

 private:
  std::vector<MotionStep> steps_;
};

}  // namespace placegraph
