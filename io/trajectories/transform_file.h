#pragma once
#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace placegraph {

/// A rigid motion from numbers: 7 (x y z qx qy qz qw), 8 (a line of TUM, whose time is not used),
/// 12 or 16 (a matrix, row by row).
/// Throws ArgumentError for another number of them, a part that is no rotation (1e-2), or a last
/// row that is not 0 0 0 1.
Eigen::Isometry3d transform_of(const std::vector<double>& numbers);

/// Reads a rigid motion from a file: such numbers on one or several lines, or JSON.
/// The keys of JSON are x, y, z, qx, qy, qz, qw. Throws FileError.
Eigen::Isometry3d read_transform(const std::string& path);

}  // namespace placegraph
