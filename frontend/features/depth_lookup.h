#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Options of lookup_depth.
struct DepthLookupOptions {
  double radius_px = 1.5;        ///< depths within this radius are averaged
  double margin_px = 5;          ///< radius within which depths must agree, at margin_focal_px
  double margin_focal_px = 525;  ///< focal length for which margin_px is given
  double max_spread = 0.05;      ///< maximum spread of depths within the margin, relative
};

/// Depth (z in the colour camera's frame [m]) at pixels of the colour image.
///
/// The depth image is in its own camera's grid: every depth pixel is projected into the colour
/// image, nearest surface first, and the depths within `radius_px` are averaged. Nothing where
/// there is no depth, or where near and far surfaces meet within `margin_px` (spread above
/// `max_spread` of the depth): there a small error of the relative pose of the two cameras would
/// select the wrong surface. Such an error is one of direction, so the margin is given for a focal
/// length of `margin_focal_px` and scales with the camera's: images of half the size have half the
/// margin.
std::vector<std::optional<double>> lookup_depth(const Image& depth_m, const Camera& camera,
                                                const DepthCamera& depth_camera,
                                                const std::vector<Eigen::Vector2f>& px,
                                                const DepthLookupOptions& options = {});

/// Depth at a pixel and how the inverse depth changes around it.
struct SurfaceDepth {
  double depth_m = 0;
  /// Gradient of the inverse depth [1/m per px]; zero where it is not determined.
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
};
/// The same with the slope of the surface, from a plane through the depths within the margin.
std::vector<std::optional<SurfaceDepth>> lookup_surfaces(const Image& depth_m, const Camera& camera,
                                                         const DepthCamera& depth_camera,
                                                         const std::vector<Eigen::Vector2f>& px,
                                                         const DepthLookupOptions& options = {});
/// g of the plane g^T X = 1 through the surface that the ray (z = 1) of its pixel meets; zero where
/// the gradient is not determined.
Eigen::Vector3d plane_through(const Camera& camera, const Eigen::Vector3d& ray,
                              const SurfaceDepth& surface);

}  // namespace placegraph
