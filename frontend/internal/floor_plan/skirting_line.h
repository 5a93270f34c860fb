#pragma once
#include <placegraph/frontend/floor_plan/floor_plan_options.h>
#include <placegraph/frontend/internal/scene/orientation_map.h>
#include <placegraph/graph/scene/indoor_map.h>

namespace placegraph {

/// Points of the surfaces in one image, in the camera frame: floor pixels of an orientation map lie
/// on the floor, `height_m` under the camera; walls stand where it ends below them, turned as their
/// labels say, and reach as far up as the label does (METHODS: X = h x / (n . x)). `segments` and
/// their `axis` are those that the map was made of. Empty where the map shows no floor. Throws
/// ArgumentError if the numbers of segments and axes differ or the height is not positive.
[[nodiscard]] std::vector<SurfacePoint> surface_points_on_floor(
    const OrientationMap& map, const std::vector<LineSegment>& segments,
    const std::vector<int>& axis, const Camera& camera, const SO3& R_cam_manhattan, double height_m,
    const SkirtingLineOptions& options = {});

}  // namespace placegraph
