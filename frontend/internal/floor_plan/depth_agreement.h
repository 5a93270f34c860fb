#pragma once
#include <placegraph/frontend/internal/floor_plan/sweep_geometry.h>
#include <placegraph/graph/image/image.h>

#include <vector>

namespace placegraph {

/// What a pixel tells of its depth before other views are asked.
struct PixelDepth {
  double inverse_depth = 0;  ///< [1/m]; 0: nothing
  double cost = 0;
  bool distinct = false;  ///< the pixel tells it by itself
};

/// The depth of an image's pixels, and how well it is known.
struct SweptDepth {
  Camera camera;
  Image depth_m;        ///< CV_32FC1, 0 = none
  Image sigma_inverse;  ///< CV_32FC1, of 1 / depth [1/m], where there is a depth
  Image certain;        ///< CV_8UC1, 255 where each pixel about it tells that depth by itself
};

/// Keeps the depths that the better half of the views agrees to: where a view sees the point it
/// sees, of all points that fall on that pixel, the one with the least cost, and that is this one
/// or has its depth. A depth whose deviation is over a fifth of it is not kept. `found`: of the
/// pixels of the geometry's camera, row by row; `sigma_px`: of where a surface is seen in a view.
[[nodiscard]] SweptDepth agreed_depth(const std::vector<PixelDepth>& found,
                                      const SweepGeometry& geometry, double sigma_px);

}  // namespace placegraph
