#pragma once
#include <placegraph/frontend/floor_plan/floor_plan_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/scene/floor_plan.h>

namespace placegraph {

/// Computes surface points of a depth image (CV_32FC1 [m], 0 = none) of `depth_camera`.
///
/// The points are in the frame that `T_cam_depth` leads to. On a plane the inverse depth is linear
/// in the pixel: if that of a patch is, its plane gives the normal. Standard deviations are those
/// of the patch, at least those of inverse depth, `sigma_inverse` [1/m] (CV_32FC1, one per pixel).
/// Throws ArgumentError for an image of another size or type.
std::vector<SurfacePoint> surface_points(const Image& depth_m, const Image& sigma_inverse,
                                         const Camera& depth_camera, const SE3& T_cam_depth,
                                         const SurfacePointOptions& options = {});
/// Computes surface points with the same standard deviation for all pixels: `sigma_at_1m` z^2 [m].
std::vector<SurfacePoint> surface_points(const Image& depth_m, const Camera& depth_camera,
                                         const SE3& T_cam_depth, double sigma_at_1m,
                                         const SurfacePointOptions& options = {});

/// Depth of every pixel of the left camera on which both cameras agree: CV_32FC1 [m], 0 = none.
///
/// Semi-global matching (Hirschmueller 2008), by OpenCV.
Image dense_stereo(const Image& left, const Image& right, double fx, double baseline_m,
                   const DenseStereoOptions& options = {});

}  // namespace placegraph
