#pragma once
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/io/files/text_file.h>

namespace placegraph {

/// R = R_z(yaw) R_y(pitch) R_x(roll) [rad]: the angles of the TORO and iSAM formats.
SO3 rotation_of_euler_angles(double roll, double pitch, double yaw);

/// Six fields "x y z roll pitch yaw". Throws FileError with the line.
SE3 parse_euler_pose(const TextFile& file, const std::vector<std::string_view>& fields,
                     std::size_t at);

}  // namespace placegraph
