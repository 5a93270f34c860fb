#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/measurements/measured_motion.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace placegraph {
namespace {

std::vector<MotionStep> steps_of(const Trajectory& trajectory, const MotionNoise& noise) {
  std::vector<MotionStep> steps;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const StampedPose &a = trajectory.poses[i - 1], &b = trajectory.poses[i];
    if (!a.T_world_body || !b.T_world_body) continue;
    const SE3 T_a_b = SE3(*a.T_world_body).inverse() * SE3(*b.T_world_body);
    steps.push_back({a.stamp_ns, b.stamp_ns, T_a_b, noise.covariance(T_a_b)});
  }
  return steps;
}

}  // namespace

void MotionNoise::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, MotionNoise& o) {
  field("translation", o.translation, "standard deviation of each coordinate after 1 m of path [m]",
        {1e-6, 100});
  field("rotation_deg", o.rotation_deg,
        "standard deviation about each axis after 1 m of path [deg]", {1e-6, 180});
  field("translation_m", o.translation_m,
        "standard deviation of each coordinate that every step adds [m]", {1e-9, 100});
  field("rotation_step_deg", o.rotation_step_deg,
        "standard deviation about each axis that every step adds [deg]", {1e-9, 180});
}

Matrix6d MotionNoise::covariance(const SE3& T_from_to) const {
  const double length_m = T_from_to.translation().norm();
  Vector6d variance;
  variance.head<3>().setConstant(translation * translation * length_m +
                                 translation_m * translation_m);
  variance.tail<3>().setConstant(
      kRadPerDeg * kRadPerDeg *
      (rotation_deg * rotation_deg * length_m + rotation_step_deg * rotation_step_deg));
  return variance.asDiagonal();
}

MeasuredMotion::MeasuredMotion(std::vector<MotionStep> steps) : steps_(std::move(steps)) {
  require(!steps_.empty(), "measured motion: there is no step");
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const std::string name = "measured motion: step " + std::to_string(i);
    require(steps_[i].to_ns > steps_[i].from_ns, name + " takes no time");
    require(i == 0 || steps_[i].from_ns >= steps_[i - 1].to_ns,
            name + " begins before the end of the previous one");
    require(steps_[i].T_from_to.matrix().allFinite() && steps_[i].covariance.allFinite(),
            name + " is not finite");
  }
}

MeasuredMotion::MeasuredMotion(const Trajectory& trajectory, const MotionNoise& noise)
    : MeasuredMotion(steps_of(trajectory, noise)) {}

std::optional<MeasuredMotion::Motion> MeasuredMotion::between(std::int64_t a_ns,
                                                              std::int64_t b_ns) const {
  if (b_ns < a_ns) return std::nullopt;
  Motion motion;
  if (a_ns == b_ns) return motion;
  auto step = std::upper_bound(steps_.begin(), steps_.end(), a_ns,
                               [](std::int64_t t, const MotionStep& s) { return t < s.to_ns; });
  for (std::int64_t now = a_ns; now < b_ns; ++step) {
    if (step == steps_.end() || step->from_ns > now) return std::nullopt;
    const std::int64_t until = std::min(b_ns, step->to_ns);
    const double share =
        static_cast<double>(until - now) / static_cast<double>(step->to_ns - step->from_ns);
    const SE3 T_now_until = share == 1 ? step->T_from_to : SE3::exp(share * step->T_from_to.log());
    const Matrix6d adjoint = T_now_until.inverse().adjoint();
    motion.covariance =
        (adjoint * motion.covariance * adjoint.transpose() + share * step->covariance).eval();
    motion.T_a_b = motion.T_a_b * T_now_until;
    now = until;
  }
  return motion;
}

MeasuredMotion MeasuredMotion::seen_from(const SE3& T_other_body) const {
  const Matrix6d adjoint = T_other_body.adjoint();
  std::vector<MotionStep> steps = steps_;
  for (MotionStep& step : steps) {
    step.T_from_to = T_other_body * step.T_from_to * T_other_body.inverse();
    step.covariance = (adjoint * step.covariance * adjoint.transpose()).eval();
  }
  return MeasuredMotion(std::move(steps));
}

}  // namespace placegraph
