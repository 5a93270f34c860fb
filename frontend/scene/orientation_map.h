#pragma once
#include <placegraph/frontend/scene/scene_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line_segment.h>
#include <placegraph/graph/geometry/so3.h>
#include <placegraph/graph/image/image.h>

#include <array>
#include <cstdint>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Orientation of the surface behind each pixel, from edges.
struct OrientationMap {
  /// Too few data: edges of fewer than two axes.
  Outcome outcome;
  /// CV_8UC1, size of the image: 0 for unknown, else 1 + the axis of the Manhattan frame that is
  /// parallel to the surface's normal.
  Image labels;
  Image confidence;       ///< CV_32FC1, 0 .. 1: share of the four sweeps that agree
  int vertical_axis = 1;  ///< axis nearest to the camera's y
  double coverage = 0;    ///< share of pixels with an orientation
};

/// Estimates surfaces of a Manhattan scene by line sweeping (Lee, Hebert & Kanade 2009).
///
/// "Geometric reasoning for single image structure recovery": an edge along axis a that is swept
/// towards the vanishing point of b covers a surface whose normal is the third axis, until it meets
/// an edge that is not on such a surface. The sweep is done per pixel: the search starts from each
/// pixel in both directions along the lines through the vanishing points, and finds the first edge
/// that is not along b. A surface needs support from a sweep of each of its two axes; no sweep
/// passes its vanishing point, where every plane of the orientation ends; pixels with equal support
/// for two orientations have none. `axis`: one per segment, -1 for none, as in ManhattanFrame.
/// Throws ArgumentError if the numbers of segments and axes differ.
[[nodiscard]] OrientationMap compute_orientation_map(const std::vector<LineSegment>& segments,
                                                     const std::vector<int>& axis,
                                                     const Camera& camera,
                                                     const SO3& R_cam_manhattan,
                                                     const OrientationMapOptions& options = {});

/// Kind of an indoor surface.
enum class PlanSurface : std::uint8_t { kNone, kFloor, kCeiling, kWall };
/// Name of a surface.
const char* to_string(PlanSurface surface);

/// Classifies the surfaces of an orientation map.
///
/// Floor is below the horizon of the vertical axis, ceiling above it, the others are walls. The
/// result is CV_8UC1 of PlanSurface.
Image indoor_surfaces(const OrientationMap& map, const Camera& camera, const SO3& R_cam_manhattan);

}  // namespace placegraph
