#pragma once
#include <placegraph/frontend/align/align_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Where a planar region of one image is in another one, and how well it fits there.
struct RegionAlignment {
  Outcome outcome;                                          ///< as those of align()
  Eigen::Matrix3d H_cur_ref = Eigen::Matrix3d::Identity();  ///< px_cur ~ H px_ref; only if outcome
  double corner_sigma_px = 0;  ///< standard deviation of the most uncertain corner
  double similarity = 0;       ///< on the finest level
  double agreement = 0;        ///< weighted correlation of the image and the region's prediction
  double visible_share = 0;    ///< share of the samples in view
  double inlier_share = 0;     ///< share of inliers among the samples in view
  double gain = 1;             ///< gain of the grey values from the region to the image
  double bias = 0;             ///< what is added to them [grey levels]
  int iterations = 0;          ///< steps of the gradient-based optimizers
};

/// Finds a planar region of one image in another one by direct alignment (CV_8UC1).
///
/// The result is the homography with the greatest similarity next to `H_start`, coarse to fine over
/// `levels`, each with at most `max_samples` samples. `polygon_px`: at least three corners of the
/// region. Outcomes: too few data (few samples, or too little in view), degenerate (too little
/// texture), not converged, inconsistent (the image found differs from the region). Throws
/// ArgumentError for options out of range.
[[nodiscard]] RegionAlignment align_region(const Image& image_ref, const Image& image_cur,
                                           const std::vector<Eigen::Vector2d>& polygon_px,
                                           const Eigen::Matrix3d& H_start,
                                           const AlignOptions& options = {}, int levels = 4,
                                           int max_samples = 3000);

}  // namespace placegraph
