#pragma once
#include <placegraph/graph/geometry/trajectory.h>

#include <string>
#include <vector>

namespace placegraph {

/// One kind of fault of a file of poses.
struct PoseFileFault {
  int line = 0;      ///< the first line that has it; 0: the file as a whole
  std::string text;  ///< what is wrong there, and on how many lines
};

/// What a file of poses holds if it is read as the devkit of KITTI reads it.
struct SubmittedPoses {
  Trajectory poses;  ///< T_world_cam, one for each line with text; none where the line has a fault
  std::vector<PoseFileFault> faults;  ///< by their first lines
};

/// Reads a file that shall be submitted to KITTI's odometry benchmark, and says all that is wrong.
/// A line has the twelve numbers of the upper 3x4 part of T_world_cam, row by row, between blanks:
/// no time, no number of the frame, no comment. Faults are, each with its first line: another
/// count of numbers, what is no number, what is not finite (a lost frame has no place in a
/// submission), a 3x4 matrix whose left part is no rotation (R^T R or the determinant differ from 1
/// by more than 1e-3, as numbers with three digits behind the point do), a byte order mark, an
/// empty file. Throws FileError if the file cannot be read as text.
SubmittedPoses read_submitted_poses(const std::string& path);

}  // namespace placegraph
