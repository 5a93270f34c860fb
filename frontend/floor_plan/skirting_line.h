#pragma once
#include <placegraph/frontend/floor_plan/floor_plan_options.h>
#include <placegraph/frontend/scene/orientation_map.h>
#include <placegraph/graph/scene/floor_plan.h>

namespace placegraph {

/// Computes surface points of one image, in the camera frame, from an orientation map.
///
/// Floor pixels are on the floor, `height_m` under the camera; walls are at the end of the floor
/// below them, oriented as their labels, and extend as far up as the label does (METHODS: X = h x /
/// (n . x)). `segments` and their `axis` are those from which the map was made. Empty if the map
/// has no floor. Throws ArgumentError if the numbers of segments and axes differ or the height is
/// not positive.
[[nodiscard]] std::vector<SurfacePoint> surface_points_on_floor(
    const OrientationMap& map, const std::vector<LineSegment>& segments,
    const std::vector<int>& axis, const Camera& camera, const SO3& R_cam_manhattan, double height_m,
    const SkirtingLineOptions& options = {});

}  // namespace placegraph
