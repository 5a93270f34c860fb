#pragma once
#include <placegraph/frontend/floor_plan/depth_agreement.h>
#include <placegraph/frontend/floor_plan/floor_plan_options.h>
#include <placegraph/frontend/floor_plan/semi_global.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>

#include <vector>

namespace placegraph {

/// Another image of the same camera, without distortion.
struct SweptView {
  Image image;     ///< CV_8UC1
  SE3 T_view_cam;  ///< from the camera of the image whose depth is computed
};

/// Computes the depth of an image's pixels from views of known motion (Collins 1996).
///
/// Planes are swept through space and their predicted images are compared with the image. The
/// better half of the views counts, as the surface may be hidden in the others (Kang, Szeliski &
/// Chai 2001), and neighbouring pixels have neighbouring depths (sum_over_paths). A depth is kept
/// if no other depth explains the pixel as well, the better half of the views agrees, and its
/// standard deviation is at most a fifth of it. All depths are 0 if no view has moved. The size is
/// the camera's, halved until it is narrow enough. Throws ArgumentError for images of another size
/// or type, and cameras with distortion.
[[nodiscard]] SweptDepth sweep_planes(const Image& image, const Camera& camera,
                                      const std::vector<SweptView>& views,
                                      const PlaneSweepOptions& options = {});

}  // namespace placegraph
