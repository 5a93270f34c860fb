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

namespace placegraph {

/// How the surface behind each pixel is turned, as edges tell.
struct OrientationMap {
  /// Too few data: edges of fewer than two axes.
  Outcome outcome;
  /// CV_8UC1, size of the image: 0 where nothing is told, else 1 + the axis of the world that the
  /// surface's normal lies along.
  Image labels;
  Image confidence;       ///< CV_32FC1, 0 .. 1: share of the four sweeps that agree
  int vertical_axis = 1;  ///< the axis nearest to the camera's y
  double coverage = 0;    ///< share of pixels with an orientation
};

/// Surfaces of a rectangular scene, by line sweeping (Lee, Hebert & Kanade 2009, "Geometric
/// reasoning for single image structure recovery"): an edge along axis a, swept towards the
/// vanishing point of b, covers a surface whose normal is the third axis, until it meets an edge
/// that lies on no such surface. Swept per pixel: from each, the first edge that is not along b on
/// the lines through that point, both ways. A surface must be told by a sweep of each of its two
/// axes; no sweep passes its vanishing point, where every plane of the orientation ends; pixels
/// that two orientations claim alike have none. `axis` is per segment, -1 for none, as
/// ManhattanFrame's. Throws ArgumentError if the numbers of segments and axes differ.
[[nodiscard]] OrientationMap compute_orientation_map(const std::vector<LineSegment>& segments,
                                                     const std::vector<int>& axis,
                                                     const Camera& camera,
                                                     const SO3& R_cam_manhattan,
                                                     const OrientationMapOptions& options = {});

/// What an indoor surface is.
enum class IndoorSurface : std::uint8_t { kNone, kFloor, kCeiling, kWall };
const char* to_string(IndoorSurface surface);

/// Floor below the horizon of the vertical axis, ceiling above it, walls: CV_8UC1 of IndoorSurface.
Image indoor_surfaces(const OrientationMap& map, const Camera& camera, const SO3& R_cam_manhattan);

}  // namespace placegraph
