#pragma once
#include <placegraph/eval/trajectory/evaluation_options.h>
#include <placegraph/eval/trajectory/pairing.h>
#include <placegraph/eval/trajectory/result.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Judges an estimated trajectory (T_world_body, the same body as the ground truth's): pairs the
/// two, aligns, and computes ATE, RPE and segment errors, warning where the estimate looks
/// inverted, mis-scaled or time-shifted. A scale fitted by kSim3 or kScale is applied before every
/// figure; kSe3 and kOrigin leave relative figures as they are. Outcome: as pair_trajectories and
/// align; a straight path (rank 1) is no failure, as the ATE is well defined on it. Figures the
/// data do not allow (too short a path) carry their own outcome and a warning.
[[nodiscard]] EvaluationResult evaluate(const Trajectory& truth, const Trajectory& estimate,
                                        const EvaluationOptions& options = {},
                                        const std::string& name = "estimate");
/// The same of what pair_trajectories made with the options' association: for long trajectories,
/// which need not be kept beside their pairs.
[[nodiscard]] EvaluationResult evaluate(PairingResult paired, const EvaluationOptions& options = {},
                                        const std::string& name = "estimate");

}  // namespace placegraph
