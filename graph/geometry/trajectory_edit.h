#pragma once
#include <placegraph/graph/geometry/trajectory.h>

#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The frames of a trajectory at some indices, which ascend.
/// Of a trajectory without times they keep their numbers.
Trajectory frames_at(const Trajectory& trajectory, const std::vector<std::size_t>& indices);

/// The frames with stamps from the first to the last one, both included.
Trajectory frames_between(const Trajectory& trajectory, std::int64_t first_ns,
                          std::int64_t last_ns);

/// The longest time between neighbours that is no gap: five times the median [ns].
/// Of frames without times it is in their numbers; 0 if there are fewer than two frames.
std::int64_t longest_spacing_ns(const Trajectory& trajectory);

/// The poses at `stamps_ns`, interpolated in a recording with another clock rate.
/// The recording may be denser or sparser; frames without a pose within `max_gap_s` get none. The
/// warnings of its reader are kept.
Trajectory resample(const Trajectory& recorded, const std::vector<std::int64_t>& stamps_ns,
                    double max_gap_s);

/// How far a frame is from the last one that is kept; any one of them is enough.
struct FrameSpacing {
  std::optional<double> m = std::nullopt;    ///< distance [m]
  std::optional<double> s = std::nullopt;    ///< time [s]
  std::optional<double> deg = std::nullopt;  ///< angle of the rotation [deg]
};

/// The first posed frame, and every one that is as far from the last one that is kept.
/// Lost frames are left out. Seconds are reached within the last digit of the stamps, or within what
/// doubles of seconds since 1970 round, but a thousandth of the spacing at most.
Trajectory spaced(const Trajectory& trajectory, FrameSpacing spacing);

/// The trajectory in a plane across one of the axes of the world: 0 x, 1 y, 2 z.
/// That coordinate becomes 0. The orientation becomes the rotation about that axis that is nearest
/// to it.
Trajectory in_plane(Trajectory trajectory, int across);

/// What merge() does with frames of a trajectory within the time of an earlier one.
enum class Overlap {
  kRefused,   ///< it throws
  kFirstKept  ///< it leaves them out
};

/// Result of merge().
struct MergedTrajectory {
  Trajectory trajectory;
  std::size_t left_out = 0;  ///< frames within the time of a trajectory that begins earlier
};

/// Joins trajectories of one body in one world, in the order of their times.
/// Throws ArgumentError if there is none, one has no times or no frame, only some have
/// orientations, or two overlap in time and `overlap` is kRefused.
MergedTrajectory merge(std::vector<Trajectory> parts, Overlap overlap);

/// The parts of a trajectory between times without a pose of more than `max_gap_s`.
/// Lost frames at the ends of a part are left out. Throws ArgumentError for a trajectory without
/// times.
std::vector<Trajectory> split_at_gaps(const Trajectory& trajectory, double max_gap_s);

/// The parts of a trajectory of `length_s` each, from the first frame on; those with a pose.
/// Throws ArgumentError for a trajectory without times, or a length that is not positive.
std::vector<Trajectory> split_every(const Trajectory& trajectory, double length_s);

}  // namespace placegraph
