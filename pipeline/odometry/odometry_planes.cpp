#include <placegraph/pipeline/odometry/odometry.h>

namespace placegraph {

/// Only a depth camera tells of planes: what two eyes make of blank walls is smooth, and wrong.
void Odometry::look_at_planes(const Frame& frame) {
  if (frame.depth.empty()) return;
  const auto span = times_.measure("planes");
  std::vector<DepthPlane> planes;
  for (const DepthPlane& plane :
       find_depth_planes(frame.depth, calibration_.depth->camera, options_.planes.depth))
    planes.push_back(transform(calibration_.depth->T_cam_depth, plane));
  planes_->add(last_keyframe_, planes, window_);
}

}  // namespace placegraph
