#include "apps/image/scene/orientation_check.h"
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace placegraph::apps {

void check_orientation(const Image& labels, const Eigen::Matrix3d& R_cam_manhattan,
                       const Image& planes, const std::vector<Eigen::Vector3d>& normals_world,
                       const Eigen::Matrix3d& R_cam_world, OrientationCheck& check) {
  require(labels.size() == planes.size() && labels.type() == CV_8UC1 && planes.type() == CV_16UC1,
          "orientation check: labels CV_8UC1 and planes CV_16UC1 of one size are needed");
  std::vector<int> truth;  // per plane: 1 + axis, 0: none
  const Eigen::Matrix3d R_manhattan_world = R_cam_manhattan.transpose() * R_cam_world;
  for (const Eigen::Vector3d& normal : normals_world) {
    int axis = 0;
    const double cosine = (R_manhattan_world * normal).cwiseAbs().maxCoeff(&axis);
    truth.push_back(cosine > std::cos(std::numbers::pi / 6) ? axis + 1 : 0);
  }
  for (int v = 0; v < labels.rows; ++v)
    for (int u = 0; u < labels.cols; ++u) {
      const std::uint16_t plane = planes.at<std::uint16_t>(v, u);
      require(plane < truth.size(), "orientation check: a plane without normal");
      if (plane == 0) continue;
      ++check.judged;
      const int message = labels.at<std::uint8_t>(v, u);
      check.oriented += message != 0;
      check.right += message != 0 && message == truth[plane];
    }
}

}  // namespace placegraph::apps
