#pragma once
#include <placegraph/frontend/align/align_options.h>
#include <placegraph/frontend/align/genetic_search.h>
#include <placegraph/frontend/align/gradient_alignment.h>
#include <placegraph/graph/core/outcome.h>

namespace placegraph {

/// Warp of a planar template with its covariance and quality measures.
struct AlignResult {
  Outcome outcome;
  PlanarWarp warp;             ///< final warp; meaningful only if outcome
  Eigen::MatrixXd covariance;  ///< covariance of the warp's right tangent, see alignment_covariance
  double corner_sigma_px = 0;  ///< standard deviation of the most uncertain corner
  double independent_share = 0;  ///< see AlignmentCovariance
  double similarity = 0;         ///< on the finest level
  double agreement = 0;  ///< weighted correlation of the image and the template's prediction
  double robust_similarity =
      0;  ///< robust_similarity() on the finest level; with ZNCC if the kind is MI
  double visible_share = 0;  ///< share of the samples in view
  double inlier_share = 0;   ///< share of inliers among the samples in view
  double gain = 1, bias = 0;
  double last_step_px = 0;
  int iterations = 0;   ///< steps of the gradient-based optimizers, all levels and members
  int evaluations = 0;  ///< evaluations of members of a population
};

/// Finds a planar template in an image.
///
/// The result is the warp of start's family with the greatest similarity, coarse to fine over the
/// levels of the template. Outcomes: too few data (the template has fewer samples than min_samples,
/// or less than min_visible_share of it is in view), degenerate (too little texture: a corner's
/// standard deviation would exceed max_sigma_px), not converged (the last step moved a corner by
/// more than max_sigma_px or a pixel, or could not be computed), inconsistent (the image found
/// differs from the template).
[[nodiscard]] AlignResult align(const PlanarTemplate& planar_template, const Image& image_cur,
                                const PlanarWarp& start, const AlignOptions& options);
/// Finds a planar template in an image whose grey_pyramid is given.
[[nodiscard]] AlignResult align(const PlanarTemplate& planar_template,
                                const std::vector<Image>& pyramid_cur, const PlanarWarp& start,
                                const AlignOptions& options);

}  // namespace placegraph
