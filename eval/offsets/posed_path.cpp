#include <placegraph/eval/offsets/posed_path.h>
#include <placegraph/graph/core/median.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Spacings of more than so many medians are gaps. Chosen.
constexpr double kGapSpacings = 3;

/// Weights of the polynomial through values at `knots` [count], at `time` (Lagrange).
void polynomial_weights(const double* knots, int count, double time, double* weights) {
  for (int k = 0; k < count; ++k) {
    weights[k] = 1;
    for (int m = 0; m < count; ++m)
      if (m != k) weights[k] *= (time - knots[m]) / (knots[k] - knots[m]);
  }
}

}  // namespace

PosedPath::PosedPath(const Trajectory& trajectory, std::int64_t base_ns) {
  const double unit = trajectory.has_times ? 1e-9 : 1;
  times_.reserve(trajectory.size());
  poses_.reserve(trajectory.size());
  for (const StampedPose& pose : trajectory.poses) {
    if (!pose.T_world_body) continue;
    times_.push_back(unit * static_cast<double>(pose.stamp_ns - base_ns));
    poses_.emplace_back(*pose.T_world_body);
  }
  std::vector<double> spacings;
  for (std::size_t i = 1; i < times_.size(); ++i) spacings.push_back(times_[i] - times_[i - 1]);
  if (!spacings.empty()) spacing_ = median_of(std::move(spacings));
}

bool PosedPath::continues(std::size_t i) const {
  return i + 1 < times_.size() && times_[i + 1] - times_[i] <= kGapSpacings * spacing_;
}

std::optional<SE3> PosedPath::at(double time) const {
  // Stamps are whole nanoseconds, but their differences in seconds are not exact.
  const double rounding = 1e-9 * std::max(1.0, spacing_);
  const auto after = std::lower_bound(times_.begin(), times_.end(), time - rounding);
  if (after == times_.end()) return std::nullopt;
  const auto b = static_cast<std::size_t>(after - times_.begin());
  if (times_[b] - time <= rounding) return poses_[b];
  if (b == 0 || !continues(b - 1)) return std::nullopt;
  const std::size_t a = b - 1;
  const bool cubic = a > 0 && continues(a - 1) && continues(b);
  const std::size_t first = cubic ? a - 1 : a;
  const int count = cubic ? 4 : 2;
  double weights[4];
  polynomial_weights(&times_[first], count, time, weights);
  const SE3& T_world_a = poses_[a];
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero(), rotation = Eigen::Vector3d::Zero();
  for (int k = 0; k < count; ++k) {
    const SE3& T_world_k = poses_[first + static_cast<std::size_t>(k)];
    position_m += weights[k] * (T_world_k.translation() - T_world_a.translation());
    rotation += weights[k] * (T_world_a.rotation().inverse() * T_world_k.rotation()).log();
  }
  return SE3(T_world_a.rotation().plus(rotation), T_world_a.translation() + position_m);
}

std::optional<Vector6d> PosedPath::twist(double time, double half) const {
  const std::optional<SE3> before = at(time - half), now = at(time), after = at(time + half);
  if (!before || !now || !after) return std::nullopt;
  Vector6d twist;
  twist << now->rotation().inverse() * (after->translation() - before->translation()),
      (before->rotation().inverse() * after->rotation()).log();
  return Vector6d(twist / (2 * half));
}

}  // namespace placegraph
