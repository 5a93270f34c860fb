#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/scene/indoor_map.h>

namespace placegraph {

struct SurfacePointOptions {
  int step_px = 8;             ///< between points
  int radius_px = 8;           ///< of the patch whose plane gives the normal
  double max_residual = 0.01;  ///< of inverse depths from it, relative, rms, beside noise
  double max_range_m = 15;
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, SurfacePointOptions& options);

/// Points of the surfaces in a depth image (CV_32FC1 [m], 0 = none) of `depth_camera`, in the frame
/// that `T_cam_depth` leads to. Inverse depth is linear in the pixel on a plane: where a patch's
/// are, its plane gives the normal. Deviations are those of the patch, at least those of inverse
/// depth, `sigma_inverse` [1/m] (CV_32FC1, a pixel each). Throws ArgumentError for an image of
/// another size or type.
std::vector<SurfacePoint> surface_points(const Image& depth_m, const Image& sigma_inverse,
                                         const Camera& depth_camera, const SE3& T_cam_depth,
                                         const SurfacePointOptions& options = {});
/// With deviations that are the same all over: `sigma_at_1m` z^2 [m].
std::vector<SurfacePoint> surface_points(const Image& depth_m, const Camera& depth_camera,
                                         const SE3& T_cam_depth, double sigma_at_1m,
                                         const SurfacePointOptions& options = {});

struct DenseStereoOptions {
  int disparities = 96;  ///< searched from 0 on [px], a multiple of 16
  int window_px = 9;
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, DenseStereoOptions& options);

/// Depth of every pixel of the left eye that both eyes agree on (semi-global matching,
/// Hirschmueller 2008, by OpenCV): CV_32FC1 [m], 0 = none.
Image dense_stereo(const Image& left, const Image& right, double fx, double baseline_m,
                   const DenseStereoOptions& options = {});

}  // namespace placegraph
