#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

/// How a body moved between two times, as wheels, a laser or inertial sensors measured it.
struct MotionStep {
  std::int64_t from_ns = 0, to_ns = 0;
  SE3 T_from_to;
  Matrix6d covariance = Matrix6d::Zero();  ///< of T_from_to in its right tangent
};

/// Noise of a motion measurement that does not tell its own: a random walk, so that variances grow
/// with the way.
struct MotionNoise {
  double translation = 0.03;        ///< [m] after a metre of way
  double rotation_deg = 0.3;        ///< after a metre of way
  double translation_m = 1e-3;      ///< of every step
  double rotation_step_deg = 0.01;  ///< of every step
  void check() const;
  Matrix6d covariance(const SE3& T_from_to) const;
};
void visit(OptionVisitor& field, MotionNoise& options);

/// A body's motion over time in consecutive steps.
class MeasuredMotion {
 public:
  /// Throws ArgumentError: no step, one that takes no time, that begins before the last one ended,
  /// or that is not finite.
  explicit MeasuredMotion(std::vector<MotionStep> steps);
  /// Steps between the posed neighbours of a trajectory.
  MeasuredMotion(const Trajectory& trajectory, const MotionNoise& noise);

  struct Motion {
    SE3 T_a_b;
    Matrix6d covariance = Matrix6d::Zero();  ///< right tangent
  };
  /// From one time to a later one: steps chained, the first and last in part (a screw of constant
  /// speed, variance by its share of the time). Nothing outside the recording or across a gap.
  std::optional<Motion> between(std::int64_t a_ns, std::int64_t b_ns) const;
  /// The same for another frame that is fastened to the body.
  MeasuredMotion seen_from(const SE3& T_other_body) const;

  const std::vector<MotionStep>& steps() const { return steps_; }

 private:
  std::vector<MotionStep> steps_;
};

}  // namespace placegraph
