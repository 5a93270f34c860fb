#include <placegraph/io/graphs/euler_angles.h>

namespace placegraph {

SO3 rotation_of_euler_angles(double roll, double pitch, double yaw) {
  return SO3(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
             Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
             Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()));
}

SE3 parse_euler_pose(const TextFile& file, const std::vector<std::string_view>& fields,
                     std::size_t at) {
  const char* const names[] = {"x", "y", "z", "roll", "pitch", "yaw"};
  double v[6];
  for (std::size_t i = 0; i < 6; ++i) v[i] = file.number(fields[at + i], names[i]);
  return {rotation_of_euler_angles(v[3], v[4], v[5]), Eigen::Vector3d(v[0], v[1], v[2])};
}

}  // namespace placegraph
