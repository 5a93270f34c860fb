#pragma once
#include <placegraph/eval/trajectory/evaluation_options.h>
#include <placegraph/eval/association/pairing.h>
#include <placegraph/eval/trajectory/result.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Evaluates a trajectory against the ground truth: ATE, RPE and KITTI segment errors.
///
/// Both are T_world_body of the same body. The two are paired and aligned as the options say; the
/// result has a warning if the estimate seems inverted, mis-scaled or time-shifted. A scale fitted
/// by kSim3 or kScale is applied before every figure; kSe3 and kOrigin do not change relative
/// figures. Outcome: as pair_trajectories and align; a straight path (rank 1) is no failure, as the
/// ATE is well defined on it. Figures that the data do not allow (too short a path) carry their own
/// outcome and a warning. `name` is the estimate's name in tables. Throws ArgumentError for options
/// that check() refuses and stamps that do not increase.
[[nodiscard]] EvaluationResult evaluate(const Trajectory& truth, const Trajectory& estimate,
                                        const EvaluationOptions& options = {},
                                        const std::string& name = "estimate");
/// Evaluates trajectories that pair_trajectories has paired with the options' association.
///
/// For long trajectories, which need not be stored in addition to their pairs. Otherwise as above.
[[nodiscard]] EvaluationResult evaluate(PairingResult paired, const EvaluationOptions& options = {},
                                        const std::string& name = "estimate");

}  // namespace placegraph
