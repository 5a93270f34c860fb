#include <placegraph/eval/association/frame_pair.h>

#include <cmath>

namespace placegraph {

double rotation_angle(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d twice_sin_axis(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  return std::atan2(twice_sin_axis.norm(), R.trace() - 1.0);
}

double twist_angle(const Eigen::Matrix3d& R, const Eigen::Vector3d& axis) {
  const Eigen::Quaterniond q(R);
  return 2 * std::atan2(std::abs(q.vec().dot(axis)), std::abs(q.w()));
}

std::vector<double> travelled_m(const std::vector<FramePair>& pairs) {
  std::vector<double> distance_m(pairs.size(), 0.0);
  for (std::size_t i = 1; i < pairs.size(); ++i)
    distance_m[i] =
        distance_m[i - 1] +
        (pairs[i].T_world_truth.translation() - pairs[i - 1].T_world_truth.translation()).norm();
  return distance_m;
}

}  // namespace placegraph
