#pragma once
#include <placegraph/graph/core/camera.h>
#include <placegraph/graph/core/image.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Depth (z in the colour camera's frame [m]) at pixels of the colour image, from a depth image in
/// its own camera's grid: every depth pixel is carried over and the nearest surface within
/// `radius_px` counts. Nothing where no depth falls, or where near and far surfaces meet (spread
/// above `max_spread` of the depth).
std::vector<std::optional<double>> lookup_depth(const Image& depth_m, const Camera& camera,
                                                const DepthCamera& depth_camera,
                                                const std::vector<Eigen::Vector2f>& px,
                                                double radius_px = 1.5, double max_spread = 0.05);

}  // namespace placegraph
