#pragma once
#include <placegraph/graph/geometry/trajectory.h>

#include <string>

namespace placegraph {

enum class TrajectoryFormat {
  kKitti,  ///< 12 numbers a line, row-major 3x4 T_world_cam; no times; lost: twelve nan
  kTum,    ///< "t tx ty tz qx qy qz qw", t in seconds; lost frames left out; # comments
  kEuroc,  ///< "t_ns,px,py,pz,qw,qx,qy,qz,..." (CSV, extra columns ignored), T_world_body
};

/// By its first data line (12 numbers | 8 numbers | commas); extension plays no part. Throws
/// FileError.
TrajectoryFormat detect_trajectory_format(const std::string& path);

/// Reads any of the three; KITTI has no times of its own: `times_path` (one number [s] a line, as
/// many as poses), else stamps are indices and has_times is false. Throws FileError with the line:
/// missing, empty, wrong count, not a number, times not increasing, quaternion not of unit length
/// (1e-2).
Trajectory read_trajectory(const std::string& path, const std::string& times_path = {});

/// Atomically, 9 digits after the point for metres, nanoseconds kept exactly. Lost frames as above.
void write_trajectory(const std::string& path, const Trajectory& trajectory,
                      TrajectoryFormat format);

}  // namespace placegraph
