#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Depth (z in the colour camera's frame [m]) at pixels of the colour image, from a depth image in
/// its own camera's grid: every depth pixel is carried over, nearest surface first, and the mean
/// within `radius_px` counts. Nothing where no depth falls, or where near and far meet within
/// `margin_px` (spread above `max_spread` of the depth): there a small error of the two cameras'
/// pose would take the wrong surface. Such an error is one of direction, so the margin is given for
/// a focal length of `margin_focal_px` and follows the camera's: images of half the size have half
/// of it.
struct DepthLookupOptions {
  double radius_px = 1.5;
  double margin_px = 5;
  double margin_focal_px = 525;
  double max_spread = 0.05;
};
std::vector<std::optional<double>> lookup_depth(const Image& depth_m, const Camera& camera,
                                                const DepthCamera& depth_camera,
                                                const std::vector<Eigen::Vector2f>& px,
                                                const DepthLookupOptions& options = {});

}  // namespace placegraph
