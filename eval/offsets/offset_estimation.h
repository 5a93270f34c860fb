#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Which constant offsets between two trajectories are estimated.
struct OffsetOptions {
  bool body = false;   ///< the pose of the truth's body in the estimate's
  bool time = false;   ///< the time between the stamps of both
  bool scale = false;  ///< with a scale of the estimate (of a monocular camera), fitted along
  double start_s = 0;  ///< known beforehand, added to the estimate's stamps
  double max_time_s = 5;  ///< largest time that is sought beyond it, either way
  void check() const;
};
void visit(OptionVisitor& field, OffsetOptions& options);

/// A direction of the offsets that the motions do not show.
///
/// In the axes of the estimate's body. Where every direction of the lever arm or of the rotation is
/// free, there is one for all, without a vector.
struct FreeOffset {
  Eigen::Vector3d lever_arm = Eigen::Vector3d::Zero();  ///< unit vector, or zero
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();   ///< axis as unit vector, or zero
  bool time = false;                                    ///< the time takes part
  bool scale = false;                                   ///< the scale takes part
  std::string text;                                     ///< one line: what is free, and why
};

/// The constant offsets between two trajectories of bodies that are rigidly connected.
///
/// T_world_truth(t + time) = S T_world_estimate(t) T_estimate_truth, with any alignment S of the
/// worlds. Along directions that are free the offsets are left as they were: a lever arm and a time
/// at zero, a rotation at that nearest to none. Deviations are infinite for components that a free
/// direction moves, else standard deviations of which 1.96 hold the true value in 95 % of cases.
struct OffsetEstimate {
  /// kTooFewData; kInconsistent: times on one side only; kNotConverged; kDegenerate: of something
  /// that is asked for the motions show nothing at all.
  Outcome outcome;
  bool with_body = false, with_time = false;  ///< what was asked for
  SE3 T_estimate_truth;                       ///< the truth's body in the estimate's [m]
  double time_s = 0;  ///< added to the estimate's stamps: start_s and what was found
  double scale = 1;   ///< metres of the truth per unit of the estimate
  Eigen::Vector3d lever_arm_deviation_m = Eigen::Vector3d::Zero();    ///< along the body's axes
  Eigen::Vector3d rotation_deviation_rad = Eigen::Vector3d::Zero();  ///< about the body's axes
  double time_deviation_s = 0;    ///< of time_s
  std::vector<FreeOffset> free;   ///< what the motions do not show
  int motions = 0;                ///< pairs of poses that were compared
  double motion_s = 0;            ///< time between the two of a pair; frames without times
  double translation_rms_m = 0;   ///< scatter of the motions' errors, along an axis
  double rotation_rms_rad = 0;    ///< and about an axis
  bool has_rotation = true;       ///< false: positions alone, no rotation is estimated
};

/// Estimates constant offsets of body and time from the motions of both trajectories.
///
/// Poses are T_world_body of either. Relative motions of the two bodies are X^-1 M X (Park and
/// Martin 1994, sensor calibration on SE(3)) at times that differ by a constant, by whose
/// correlation of speeds the search begins (Furgale et al. 2013); all are fitted at once,
/// robustly, with a scale if asked for. No alignment of the worlds enters, and drift only as far as
/// it grows during a motion. Deviations are those of the slowest waves of the errors, which may be
/// correlated. If either has positions alone, rotations between the bodies are not estimated, and a
/// lever arm needs the estimate's orientations. Throws ArgumentError for options that check()
/// refuses, if neither is asked for, and if stamps do not increase.
[[nodiscard]] OffsetEstimate estimate_offsets(const Trajectory& truth, const Trajectory& estimate,
                                              const OffsetOptions& options);

/// The estimate with the truth's body and stamps: T_world_body T_estimate_truth, later.
/// The lever arm is in units of the estimate, that is, divided by the scale.
[[nodiscard]] Trajectory with_offsets(const Trajectory& estimate, const OffsetEstimate& offsets);

/// Lines for people: values with deviations, and what is free.
/// Without an estimate, its reason.
[[nodiscard]] std::string to_text(const OffsetEstimate& offsets);

/// A JSON object without a newline: the members above, null for what is not known.
[[nodiscard]] std::string to_json(const OffsetEstimate& offsets);

}  // namespace placegraph
