#pragma once
#include <placegraph/frontend/floor_plan/sweep_geometry.h>
#include <placegraph/graph/image/image.h>

#include <vector>

namespace placegraph {

/// Depth of a pixel by plane sweep, before the agreement of other views is tested.
struct PixelDepth {
  double inverse_depth = 0;  ///< inverse depth [1/m]; 0: none
  double cost = 0;
  bool distinct = false;  ///< the depth is distinct without the pixel's neighbours
};

/// Depth of an image's pixels, and its accuracy.
struct SweptDepth {
  Camera camera;
  Image depth_m;        ///< CV_32FC1, 0 = none
  Image sigma_inverse;  ///< CV_32FC1, standard deviation of 1 / depth [1/m], where there is a depth
  Image certain;        ///< CV_8UC1, 255 where all pixels around have this depth and are distinct
};

/// Keeps the depths on which the better half of the views agrees.
///
/// A view shows, of all points that project to one of its pixels, the one with the least cost; the
/// view agrees if this is the point itself or has its depth. A depth with a standard deviation over
/// a fifth of itself is dropped. `found`: pixels of the geometry's camera, row by row; `sigma_px`:
/// standard deviation of the position of a surface in a view.
[[nodiscard]] SweptDepth agreed_depth(const std::vector<PixelDepth>& found,
                                      const SweepGeometry& geometry, double sigma_px);

}  // namespace placegraph
