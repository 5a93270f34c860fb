#pragma once
#include <placegraph/graph/geometry/trajectory.h>

#include <optional>
#include <vector>

namespace placegraph {

/// The posed frames of a trajectory as a function of time.
///
/// Times are seconds since a stamp that two paths share; without times, numbers of frames. Between
/// two frames the pose is the cubic through the four around it, or the straight line where one of
/// the four is missing. There is none across a gap: more than three times the median spacing.
class PosedPath {
 public:
  PosedPath(const Trajectory& trajectory, std::int64_t base_ns);

  std::optional<SE3> at(double time) const;
  /// Velocity [m/s] and angular velocity [rad/s] in the body's frame, by the poses `half` before
  /// and after.
  std::optional<Vector6d> twist(double time, double half) const;

  const std::vector<double>& times() const { return times_; }
  const SE3& pose(std::size_t i) const { return poses_[i]; }
  double spacing() const { return spacing_; }  ///< median; 0 with fewer than two frames
  /// Whether frames i and i + 1 are both there and not separated by a gap.
  bool continues(std::size_t i) const;

 private:
  std::vector<double> times_;
  std::vector<SE3> poses_;
  double spacing_ = 0;
};

}  // namespace placegraph
