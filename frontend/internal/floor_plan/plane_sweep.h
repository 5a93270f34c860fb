#pragma once
#include <placegraph/frontend/floor_plan/floor_plan_options.h>
#include <placegraph/frontend/internal/floor_plan/depth_agreement.h>
#include <placegraph/frontend/internal/floor_plan/semi_global.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>

#include <vector>

namespace placegraph {

/// Another image of the same camera, which shows no distortion.
struct SweptView {
  Image image;     ///< CV_8UC1
  SE3 T_view_cam;  ///< from the camera of the image whose depth is asked for
};

/// Depth of the pixels of an image from views of known motion: planes are swept through space, what
/// they would show is compared with the image (Collins 1996), the better half of the views counts,
/// as the others may not see the surface (Kang, Szeliski & Chai 2001), and neighbouring pixels have
/// neighbouring depths (sum_over_paths). Kept is what no other depth explains as well, what the
/// better half of the views agrees to, and what they tell to a fifth of it. All depths are 0 where
/// no view has moved. The size is the camera's, halved until it is narrow enough. Throws
/// ArgumentError for images of another size or type, and cameras with distortion.
[[nodiscard]] SweptDepth sweep_planes(const Image& image, const Camera& camera,
                                      const std::vector<SweptView>& views,
                                      const PlaneSweepOptions& options = {});

}  // namespace placegraph
