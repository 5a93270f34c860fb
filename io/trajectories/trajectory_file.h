#pragma once
#include <placegraph/graph/geometry/trajectory.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Formats in which trajectories are written; read_trajectory accepts more.
enum class TrajectoryFormat {
  kKitti,  ///< 12 numbers a line, row-major 3x4 T_world_cam; no times; lost: twelve nan
  kTum,    ///< "t tx ty tz qx qy qz qw", t in seconds; lost frames left out; # comments
  kEuroc,  ///< "t_ns,px,py,pz,qw,qx,qy,qz,..." (CSV, extra columns ignored), T_world_body
};

/// Whether poses without orientation are accepted; their rotation is then the identity.
enum class Orientation { kNeeded, kOptional };

/// Reads a trajectory from a text file with one pose per line.
///
/// A header that names the columns is used; otherwise the number of fields decides: KITTI (3x4 or
/// 4x4), TUM, EuRoC, positions alone with or without time. Blanks, tabs, commas or semicolons
/// separate the fields. COLMAP's images.txt and images.bin and the transforms.json of radiance
/// fields are read, too, as poses T_world_cam (x right, y down, z forward) in the order of the
/// names of their images, whose times or numbers are the stamps. Without times, stamps are the
/// numbers of the frames and `has_times` is false, unless `times_path` names a file of times; see
/// give_times. Of rows with one time the first is kept, with a line in `warnings`. Throws FileError
/// with the line: missing, empty, of unknown format, not a number, times that go back or numbers
/// not increasing, not a rotation (tolerance 1e-2), no orientation where it is needed.
Trajectory read_trajectory(const std::string& path, const std::string& times_path = {},
                           Orientation orientation = Orientation::kNeeded);
/// Reads a trajectory with a time in every line.
///
/// Throws FileError as read_trajectory, and if the lines have no times.
Trajectory read_timed_poses(const std::string& path,
                            Orientation orientation = Orientation::kNeeded);
/// Reads a trajectory without times, one pose per frame (KITTI).
///
/// Throws FileError as read_trajectory, and if the lines have times.
Trajectory read_frame_poses(const std::string& path);

/// Assigns the times of a file, one [s] per line and frame, to a trajectory without times.
///
/// `path` is the file of the trajectory, for messages. Throws ArgumentError if it has times,
/// FileError if a frame has none, or if there are more times than poses and the poses are not
/// numbered.
void give_times(Trajectory& trajectory, const std::string& path, const std::string& times_path);

/// Writes a trajectory; metres get 9 digits after the point, nanoseconds are kept exactly.
///
/// Lost frames are written as described in TrajectoryFormat. The file is replaced as a whole or not
/// at all. Throws FileError if it cannot be written; ArgumentError for poses without orientation or
/// not finite, times that do not increase, and a trajectory without times in a format that needs
/// them.
void write_trajectory(const std::string& path, const Trajectory& trajectory,
                      TrajectoryFormat format);

}  // namespace placegraph
