#include <placegraph/frontend/align/aligner.h>
#include <placegraph/frontend/align/region_alignment.h>

namespace placegraph {

RegionAlignment align_region(const Image& image_ref, const Image& image_cur,
                             const std::vector<Eigen::Vector2d>& polygon_px,
                             const Eigen::Matrix3d& H_start, const AlignOptions& options,
                             int levels, int max_samples) {
  options.check();
  const PlanarTemplate region(image_ref, polygon_px, levels, max_samples);
  const AlignResult found = align(region, image_cur, region.homography(H_start), options);
  return {.outcome = found.outcome,
          .H_cur_ref = found.warp.H_cur_ref(),
          .corner_sigma_px = found.corner_sigma_px,
          .similarity = found.similarity,
          .agreement = found.agreement,
          .visible_share = found.visible_share,
          .inlier_share = found.inlier_share,
          .gain = found.gain,
          .bias = found.bias,
          .iterations = found.iterations};
}

}  // namespace placegraph
