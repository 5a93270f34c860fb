#pragma once
#include <placegraph/graph/geometry/se3.h>

#include <vector>

namespace placegraph::synthetic {

/// The pose of a camera between its poses T_scene_cam at the ascending times `time_s`: a cubic in
/// time through the nearest four, beyond the ends with constant velocity. There is at least one.
SE3 pose_at(const std::vector<double>& time_s, const std::vector<SE3>& T_scene_cam, double at_s);

}  // namespace placegraph::synthetic
