#pragma once
#include <placegraph/frontend/floor_plan/depth_agreement.h>
#include <placegraph/frontend/floor_plan/semi_global.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>

#include <vector>

namespace placegraph {

struct PlaneSweepOptions {
  double min_depth_m = 0.7, max_depth_m = 15;
  int max_width_px = 400;    ///< wider images are halved
  double step_px = 1;        ///< between two planes, where a view moves most
  int max_planes = 192;      ///< farther apart where more would be needed
  int window_px = 9;         ///< over which brightness and contrast are made alike
  double noise_share = 2.7;  ///< contrast below so many deviations of noise (and 1) counts little
  int block_px = 5;          ///< over which costs are averaged
  PathCosts paths;
  double uniqueness = 0.05;  ///< by which a depth must be better than any other
  double distinct = 0.6;     ///< cost of a depth that the pixel tells by itself, of its mean cost
  double sigma_px = 0.3;     ///< of where a surface is seen in another view
  void check() const;
};
void visit(OptionVisitor& field, PlaneSweepOptions& options);

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
