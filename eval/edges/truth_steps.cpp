#include <placegraph/eval/edges/truth_steps.h>
#include <placegraph/graph/core/quantile.h>

namespace placegraph {

TruthSteps::TruthSteps(const Trajectory& trajectory) {
  for (const StampedPose& pose : trajectory.poses)
    poses.push_back(pose.T_world_body ? std::optional(SE3(*pose.T_world_body)) : std::nullopt);
  std::vector<double> lengths, rotations;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    known.push_back(poses[i] && poses[i + 1]);
    steps.push_back(Vector6d::Zero());
    if (!known.back()) continue;
    const SE3 T = poses[i]->inverse() * *poses[i + 1];
    steps.back() << T.translation(), T.rotation().log();
    lengths.push_back(steps.back().head<3>().norm());
    rotations.push_back(steps.back().tail<3>().norm());
  }
  if (lengths.empty()) {
    moves.assign(steps.size(), false);
    return;
  }
  long_step_m = quantile_of(lengths, 0.75);
  large_rotation_rad = quantile_of(rotations, 0.75);
  for (std::size_t i = 0; i < steps.size(); ++i)
    moves.push_back(known[i] && (steps[i].head<3>().norm() > 0.1 * long_step_m ||
                                 steps[i].tail<3>().norm() > large_rotation_rad));
}

}  // namespace placegraph
