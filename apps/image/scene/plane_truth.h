#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace placegraph::apps {

/// Reads the planes of a sequence with exact ground truth.
/// Lines `nx ny nz d` with n . p = d in the frame of poses.txt, the first unused. Throws FileError
/// with the line: other than four numbers, a normal (but the first) that is not of unit length; or
/// if there is no line.
std::vector<Eigen::Vector4d> read_planes(const std::string& path);

}  // namespace placegraph::apps
