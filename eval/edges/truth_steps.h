#pragma once
#include <placegraph/graph/geometry/trajectory.h>

#include <optional>
#include <vector>

namespace placegraph {

/// The poses of a trajectory and the motions from each frame to the next.
struct TruthSteps {
  explicit TruthSteps(const Trajectory& trajectory);

  std::vector<std::optional<SE3>> poses;  ///< T_world_body of each frame, nothing where it is lost
  std::vector<Vector6d> steps;            ///< [translation, rotation vector] from frame i to i + 1
  std::vector<bool> known;                ///< whether both poses of the step are known
  /// Whether the body moves in the step, rather than stands: relative to the larger steps.
  std::vector<bool> moves;
  /// Length and angle that a quarter of the known steps exceed.
  double long_step_m = 0, large_rotation_rad = 0;

  int count() const { return static_cast<int>(steps.size()); }
};

}  // namespace placegraph
