#pragma once
#include <placegraph/graph/geometry/se3.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// One line of a trajectory. The matrix is kept as it was given: files carry 7 digits, and an
/// evaluator that must match others may not re-orthonormalize them. SE3(*T_world_body) does.
struct StampedPose {
  std::int64_t stamp_ns = 0;
  std::optional<Eigen::Isometry3d> T_world_body;  ///< nothing where the frame is lost
};

/// Poses of one moving frame in a fixed one, one per input frame, in time order.
struct Trajectory {
  std::vector<StampedPose> poses;
  bool has_times = true;  ///< false: stamps are numbers of frames (a KITTI file without times)
  bool numbered = false;  ///< without times: frames may be left out, so that numbers have gaps
  bool has_orientation = true;  ///< false: positions alone; rotations are the identity

  std::size_t size() const { return poses.size(); }
  std::size_t posed() const;
};

struct AssociationOptions {
  double max_difference_s = 0.02;
  double offset_s = 0;  ///< added to the second trajectory's stamps
};

/// Pairs (index in a, index in b) of the poses nearest in time; each used once, ascending, lost
/// frames paired too. Stamps of both must be strictly increasing (ArgumentError otherwise).
std::vector<std::pair<int, int>> associate_by_time(const Trajectory& a, const Trajectory& b,
                                                   const AssociationOptions& options);

/// The pose at a time between two posed neighbours: translation linear, rotation geodesic. Nothing
/// outside the trajectory, beside a lost frame, or across a gap wider than `max_gap_s`.
std::optional<SE3> interpolate(const Trajectory& trajectory, std::int64_t stamp_ns,
                               double max_gap_s = 1.0);

}  // namespace placegraph
