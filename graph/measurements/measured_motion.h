#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

/// A body's motion between two times, measured by wheels, a laser or inertial sensors.
struct MotionStep {
  std::int64_t from_ns = 0, to_ns = 0;     ///< begin and end, from_ns < to_ns
  SE3 T_from_to;                           ///< the body at the end, in its frame at the begin
  Matrix6d covariance = Matrix6d::Zero();  ///< of T_from_to in its right tangent
};

/// Noise of motion measurements that come without a covariance, as standard deviations.
/// It is a random walk: variances grow with the length of the path.
struct MotionNoise {
  double translation = 0.03;        ///< of each coordinate after a metre of path [m]
  double rotation_deg = 0.3;        ///< of each axis after a metre of path
  double translation_m = 1e-3;      ///< of each coordinate, added by every step
  double rotation_step_deg = 0.01;  ///< of each axis, added by every step
  void check() const;
  /// Covariance of one step in its right tangent; diagonal.
  Matrix6d covariance(const SE3& T_from_to) const;
};
void visit(OptionVisitor& field, MotionNoise& options);

/// A body's motion over time in consecutive steps.
class MeasuredMotion {
 public:
  /// The motion of steps in time order; a gap between two steps is allowed.
  /// Throws ArgumentError if there is no step, or one that takes no time, begins before the last
  /// one ended or is not finite.
  explicit MeasuredMotion(std::vector<MotionStep> steps);
  /// The motion between the poses of a trajectory, with covariances by `noise`.
  /// Its steps join consecutive frames that both have a pose. Throws as above.
  MeasuredMotion(const Trajectory& trajectory, const MotionNoise& noise);

  /// The motion between two times.
  struct Motion {
    SE3 T_a_b;                               ///< the body at time b, in its frame at time a
    Matrix6d covariance = Matrix6d::Zero();  ///< of T_a_b in its right tangent
  };
  /// The motion from one time to a later one; identity with covariance zero if they are equal.
  /// Steps are chained, the first and the last in part: a screw motion of constant speed, with a
  /// covariance in proportion to its share of the time. Nothing if b is before a, outside the
  /// recording or across a gap.
  std::optional<Motion> between(std::int64_t a_ns, std::int64_t b_ns) const;
  /// The motion of another frame that is rigidly attached to the body, with its covariances.
  MeasuredMotion seen_from(const SE3& T_other_body) const;

  /// The steps in time order.
  const std::vector<MotionStep>& steps() const { return steps_; }

 private:
  std::vector<MotionStep> steps_;
};

}  // namespace placegraph
