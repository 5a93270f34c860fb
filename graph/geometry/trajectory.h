#pragma once
#include <placegraph/graph/geometry/se3.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// One pose of a trajectory, with its matrix exactly as read or computed.
/// Files have 7 digits, and an evaluator whose figures must match those of other tools must not
/// re-orthonormalize them; SE3(*T_world_body) does.
struct StampedPose {
  std::int64_t stamp_ns = 0;                      ///< time, or the number of a frame, see has_times
  std::optional<Eigen::Isometry3d> T_world_body;  ///< nothing where the frame is lost
};

/// Poses of one moving frame in a fixed one, one per input frame, in time order.
struct Trajectory {
  std::vector<StampedPose> poses;  ///< in time order
  bool has_times = true;  ///< false: stamps are numbers of frames (a KITTI file without times)
  bool numbered = false;  ///< without times: frames may be left out, so that numbers have gaps
  bool has_orientation = true;  ///< false: positions alone; rotations are the identity
  /// What a reader left out or doubts, one line each that names the file; empty if all is well.
  std::vector<std::string> warnings = {};

  /// Number of frames, lost ones included.
  std::size_t size() const { return poses.size(); }
  /// Number of frames that have a pose.
  std::size_t posed() const;
  /// Length of the polyline through the positions of the posed frames.
  double path_length() const;
};

/// Which poses of two trajectories count as simultaneous.
struct AssociationOptions {
  double max_difference_s = 0.02;  ///< largest difference of a pair's stamps, in [0, 1e9)
  double offset_s = 0;             ///< added to the second trajectory's stamps, below 1e9
};

/// Pairs (index in a, index in b) of the poses nearest in time.
/// Each pose is used once at most, indices ascend in both, lost frames are paired too. The closest
/// pair is chosen first, then the closest that crosses none chosen before. Throws ArgumentError if
/// the stamps of either are not strictly increasing or an option is out of range.
std::vector<std::pair<int, int>> associate_by_time(const Trajectory& a, const Trajectory& b,
                                                   const AssociationOptions& options);

/// The pose T_world_body at a time between two posed neighbours.
/// The translation is interpolated linearly, the rotation along the geodesic. Nothing outside the
/// trajectory, beside a lost frame, or across a gap wider than `max_gap_s`.
std::optional<SE3> interpolate(const Trajectory& trajectory, std::int64_t stamp_ns,
                               double max_gap_s = 1.0);

}  // namespace placegraph
