#pragma once
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/io/synthetic/render/height_surface.h>

namespace placegraph::synthetic {

constexpr double kWheelbase_m = 2.7, kTrackWidth_m = 1.6;

/// The pose of a camera above the middle of a car's four wheels, from its pose T_scene_cam on the
/// same ground without undulation: the wheels follow the undulation, the car its mean height and
/// its mean slopes along and across.
SE3 on_undulation(const GroundMesh& ground, const SE3& T_scene_cam);

}  // namespace placegraph::synthetic
