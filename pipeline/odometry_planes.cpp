#include <placegraph/frontend/scene/indoor_surfaces.h>
#include <placegraph/pipeline/odometry.h>

namespace placegraph {

/// What the depth camera or both eyes tell of the planes in view.
std::vector<DepthPlane> Odometry::planes_in(const Frame& frame) const {
  if (calibration_.depth && !frame.depth.empty()) {
    std::vector<DepthPlane> planes;
    for (const DepthPlane& plane :
         find_depth_planes(frame.depth, calibration_.depth->camera, options_.planes.depth))
      planes.push_back(transform(calibration_.depth->T_cam_depth, plane));
    return planes;
  }
  return {};
}

void Odometry::look_at_planes(const Frame& frame) {
  const auto span = times_.measure("planes");
  planes_->add(last_keyframe_, planes_in(frame), window_);
}

}  // namespace placegraph
