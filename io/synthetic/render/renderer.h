#pragma once
#include <placegraph/graph/image/image.h>
#include <placegraph/io/synthetic/render/rasterizer.h>

#include <optional>

namespace placegraph::synthetic {

/// A 3x4 map of points: p' = linear * p + offset.
struct AffineMap {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Zero();
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
};

/// A rendered image at an instant, before any sensor model. All maps are exact at pixel centres.
struct Rendering {
  Image grey;           ///< CV_32FC1, 0 black to 1 white, may exceed 1
  Image inverse_depth;  ///< CV_32FC1 [1/m], 0 = sky
  Image mover;          ///< CV_16SC1, index of the moving object, -1 = static
  Image labels;         ///< CV_8UC1 SurfaceClass
  Image planes;         ///< CV_16UC1 index into Scene::planes
  std::vector<SeenFace> faces;
};

/// Renders by deferred shading: visibility first, then each visible surface once per pixel. Bands
/// of rows are distributed over `threads`; the bits do not depend on their number.
Rendering render(const Scene& scene, const View& view, float contrast, bool maps, int threads);

/// Depth [m] of the pixel centre in double precision where `rendering` has a face.
Image depth_image(const Rendering& rendering);

/// Optical flow from `view` to `next` for the surfaces of `rendering` in `view`: CV_32FC2 (du, dv)
/// [px], NaN for a point behind the camera of `next`, but not for one that is hidden there. Moving
/// objects are followed; the sky rotates with the camera.
Image flow_image(const Scene& scene, const Rendering& rendering, const View& view,
                 const View& next);

}  // namespace placegraph::synthetic
