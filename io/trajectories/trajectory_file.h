#pragma once
#include <placegraph/graph/geometry/trajectory.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Forms that are written; what is read is more, see PoseTable.
enum class TrajectoryFormat {
  kKitti,  ///< 12 numbers a line, row-major 3x4 T_world_cam; no times; lost: twelve nan
  kTum,    ///< "t tx ty tz qx qy qz qw", t in seconds; lost frames left out; # comments
  kEuroc,  ///< "t_ns,px,py,pz,qw,qx,qy,qz,..." (CSV, extra columns ignored), T_world_body
};

/// Whether poses without orientation are taken; they have the identity.
enum class Orientation { kNeeded, kOptional };

/// Reads a table of poses (PoseTable). Without times, stamps are the numbers of the frames, and
/// `has_times` is false, unless `times_path` names a file of times; see give_times. Throws
/// FileError with the line: missing, empty, of no known form, not a number, times or numbers not
/// increasing, no rotation (1e-2), no orientation where it is needed.
Trajectory read_trajectory(const std::string& path, const std::string& times_path = {},
                           Orientation orientation = Orientation::kNeeded);
/// The same, but only with times of its own, or only without times; FileError for the other kind.
Trajectory read_timed_poses(const std::string& path,
                            Orientation orientation = Orientation::kNeeded);
Trajectory read_frame_poses(const std::string& path);

/// Gives a trajectory without times, which was read from `path`, the times of a file, one [s] a
/// line for every frame. Throws ArgumentError if it has times, FileError if a frame has none, or if
/// there are more times than poses and the poses are not numbered.
void give_times(Trajectory& trajectory, const std::string& path, const std::string& times_path);

/// Atomically, 9 digits after the point for metres, nanoseconds kept exactly. Lost frames as above.
void write_trajectory(const std::string& path, const Trajectory& trajectory,
                      TrajectoryFormat format);

}  // namespace placegraph
