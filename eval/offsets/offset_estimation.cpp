#include <fmt/format.h>
#include <placegraph/eval/offsets/offset_estimation.h>
#include <placegraph/eval/offsets/offset_fit.h>
#include <placegraph/eval/offsets/offset_freedom.h>
#include <placegraph/eval/offsets/speed_correlation.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

void require_increasing(const Trajectory& trajectory, const char* whose) {
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    require(trajectory.poses[i].stamp_ns > trajectory.poses[i - 1].stamp_ns,
            fmt::format("{} trajectory: the stamp at index {} does not come after the one before",
                        whose, i));
}

/// Why no estimate is tried; ok if one is.
Outcome why_not_tried(const Trajectory& truth, const Trajectory& estimate,
                      const OffsetOptions& options) {
  if (truth.has_times != estimate.has_times)
    return Outcome::failure(Outcome::Code::kInconsistent,
                            fmt::format("offsets need times on both sides or on neither: the {} "
                                        "has none",
                                        truth.has_times ? "estimate" : "ground truth"));
  if (options.time && !truth.has_times)
    return Outcome::failure(Outcome::Code::kInconsistent,
                            "a time offset needs times, and both have numbers of frames alone");
  if (options.body && !estimate.has_orientation)
    return Outcome::failure(Outcome::Code::kTooFewData,
                            "a body offset needs orientations of the estimate, which has positions "
                            "alone");
  if (std::min(truth.posed(), estimate.posed()) < 2)
    return Outcome::failure(Outcome::Code::kTooFewData, "fewer than two poses on one side");
  return Outcome::ok();
}

OffsetMask mask_of(const OffsetOptions& options, bool positions_alone) {
  OffsetMask mask{};
  for (int k = 0; k < 3; ++k) {
    mask[static_cast<std::size_t>(kLeverAt + k)] = options.body;
    mask[static_cast<std::size_t>(kRotationAt + k)] = options.body || positions_alone;
  }
  mask[kTimeAt] = options.time;
  mask[kScaleAt] = options.scale;
  return mask;
}

/// The values and deviations of a fit, in the axes of the estimate's body.
void take_values(const OffsetFit& fit, double unit_s, OffsetEstimate& result) {
  result.T_estimate_truth = fit.state.T_estimate_truth;
  result.time_s += fit.state.time_s;
  result.scale = fit.state.scale;
  result.motions = fit.motions;
  result.motion_s = fit.duration * unit_s;
  result.translation_rms_m = fit.translation_m;
  result.rotation_rms_rad = fit.rotation_rad;
  const OffsetMatrix turn = to_estimate_axes(fit, result.has_rotation);
  const OffsetVector deviation =
      (turn * fit.covariance * turn.transpose()).diagonal().cwiseMax(0).cwiseSqrt();
  const OffsetVector free = moved_by_free(fit, turn);
  const auto of = [&](int k) { return free[k] > 0 ? free[k] : deviation[k]; };
  for (int k = 0; k < 3; ++k) {
    if (result.with_body) result.lever_arm_deviation_m[k] = of(kLeverAt + k);
    if (result.with_body && result.has_rotation)
      result.rotation_deviation_rad[k] = of(kRotationAt + k);
  }
  if (result.with_time) result.time_deviation_s = of(kTimeAt);
}

/// Takes out of the lever arm what the motions do not show of it: the fit leaves rests there.
/// What is free only together with other offsets stays: without it they would no longer fit.
void leave_free_lever_arm(OffsetEstimate& result) {
  Eigen::Vector3d lever_m = result.T_estimate_truth.translation();
  for (const FreeOffset& free : result.free) {
    if (free.time || free.scale || free.rotation.norm() > 0) continue;
    // Without a vector all of it is free.
    const Eigen::Vector3d& axis = free.lever_arm;
    lever_m = axis.norm() == 0 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(lever_m - axis * axis.dot(lever_m));
  }
  result.T_estimate_truth = SE3(result.T_estimate_truth.rotation(), lever_m);
}

/// Whether something that was asked for has no part that the motions show.
Outcome judged(const OffsetEstimate& result) {
  const auto none = [](const Eigen::Vector3d& deviation) {
    return deviation.array().isInf().all();
  };
  const bool no_body = result.with_body && none(result.lever_arm_deviation_m) &&
                       (!result.has_rotation || none(result.rotation_deviation_rad));
  const bool no_time = result.with_time && std::isinf(result.time_deviation_s);
  if (!no_body && !no_time) return Outcome::ok();
  std::string reason;
  for (const FreeOffset& free : result.free)
    if (no_body || free.time) reason += (reason.empty() ? "" : "; ") + free.text;
  return Outcome::failure(Outcome::Code::kDegenerate, reason);
}

}  // namespace

void OffsetOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, OffsetOptions& o) {
  field("body", o.body, "whether the constant pose between the two bodies is estimated");
  field("time", o.time, "whether the constant time between the stamps is estimated");
  field("scale", o.scale, "whether a scale of the estimate is fitted along");
  field("start_s", o.start_s, "time added to the estimate's stamps beforehand [s]", {-1e9, 1e9});
  field("max_time_s", o.max_time_s, "largest time that is sought beyond that [s]", {0, 1e4});
}

OffsetEstimate estimate_offsets(const Trajectory& truth, const Trajectory& estimate,
                                const OffsetOptions& options) {
  options.check();
  require(options.body || options.time, "offsets: neither body nor time is to be estimated");
  require_increasing(truth, "true");
  require_increasing(estimate, "estimated");
  OffsetEstimate result;
  result.with_body = options.body;
  result.with_time = options.time;
  result.time_s = options.start_s;
  result.has_rotation = truth.has_orientation && estimate.has_orientation;
  result.outcome = why_not_tried(truth, estimate, options);
  if (!result.outcome) return result;

  const std::int64_t base_ns = truth.poses.front().stamp_ns;
  const std::int64_t start_ns = truth.has_times ? std::llround(options.start_s * 1e9) : 0;
  const PosedPath of_truth(truth, base_ns), of_estimate(estimate, base_ns - start_ns);
  OffsetState start;
  if (options.time)
    start.time_s =
        speed_shift(of_truth, of_estimate, result.has_rotation, options.max_time_s).shift_s;
  const OffsetEquations equations(of_truth, of_estimate, !result.has_rotation, options.time);
  const OffsetFit fit =
      fit_offsets(equations, mask_of(options, !result.has_rotation), start);
  result.outcome = fit.outcome;
  if (!fit.outcome) return result;
  result.free = free_offsets(fit, options, result.has_rotation);
  take_values(fit, 1, result);
  leave_free_lever_arm(result);
  result.outcome = judged(result);
  return result;
}

Trajectory with_offsets(const Trajectory& estimate, const OffsetEstimate& offsets) {
  Trajectory moved = estimate;
  const std::int64_t time_ns =
      estimate.has_times ? std::llround(offsets.time_s * 1e9) : 0;
  const SE3& X = offsets.T_estimate_truth;
  const Eigen::Isometry3d T_estimate_truth =
      SE3(X.rotation(), X.translation() / offsets.scale).isometry();
  for (StampedPose& pose : moved.poses) {
    pose.stamp_ns += time_ns;
    if (offsets.with_body && pose.T_world_body)
      pose.T_world_body = *pose.T_world_body * T_estimate_truth;
  }
  return moved;
}

}  // namespace placegraph
