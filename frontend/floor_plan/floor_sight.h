#pragma once
#include <placegraph/frontend/scene/orientation_map.h>
#include <placegraph/graph/scene/indoor_map.h>

namespace placegraph {

struct FloorSightOptions {
  double max_range_m = 6;
  int step_px = 8;
  double sigma_boundary_px = 1.5;  ///< of the row where floor and wall meet
  /// A wall's lowest edge, up to so far below where the map's floor ends, is its foot: the upper
  /// edge of a skirting board is mostly the clearer one. 0: the map alone.
  double skirting_m = 0.15;
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, FloorSightOptions& options);

/// Points of the surfaces in one image, in the camera frame: floor pixels of an orientation map lie
/// on the floor, `height_m` under the camera; walls stand where it ends below them, turned as their
/// labels say, and reach as far up as the label does (METHODS: X = h x / (n . x)). `segments` and
/// their `axis` are those that the map was made of. Empty where the map shows no floor. Throws
/// ArgumentError if the numbers of segments and axes differ or the height is not positive.
[[nodiscard]] std::vector<SurfacePoint> surface_points_on_floor(
    const OrientationMap& map, const std::vector<LineSegment>& segments,
    const std::vector<int>& axis, const Camera& camera, const SO3& R_cam_manhattan, double height_m,
    const FloorSightOptions& options = {});

}  // namespace placegraph
