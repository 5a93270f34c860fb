#pragma once
#include <placegraph/frontend/align/genetic_search.h>
#include <placegraph/frontend/align/gradient_alignment.h>
#include <placegraph/graph/core/outcome.h>

namespace placegraph {

/// Optimizer of the warp of a planar template.
enum class AlignOptimizer {
  kGaussNewton,           ///< forward compositional
  kEsm,                   ///< efficient second-order minimization
  kInverseCompositional,  ///< the template's gradients only
  kSwarm,                 ///< particle swarm
  kGenetic,               ///< genetic algorithm
  kSwarmEsm,              ///< particle swarm, its best members followed by ESM
};
const std::vector<std::string>& align_optimizer_names();

/// Options of the alignment of a planar template with an image.
struct AlignOptions {
  AlignOptimizer optimizer = AlignOptimizer::kEsm;
  GradientAlignmentOptions gradient;  ///< its similarity is also that of the population searches
  /// Initial standard deviation of a corner's coordinate in a population on the coarsest level
  /// [diagonals of the template]; every finer level uses a quarter of the coarser one's.
  double search_sigma = 0.18;
  /// Standard deviation of an additional common shift of all corners [diagonals of the template]:
  /// for templates that may move far while their shape changes less.
  double search_shift_sigma = 0;
  int search_samples = 400;  ///< samples from which the similarity of a member is computed
  int followed = 8;          ///< best members of the swarm that ESM follows
  SwarmOptions swarm;
  GeneticOptions genetic;
  int min_samples =
      100;  ///< minimum samples of the template; a coarse level with fewer is left out
  double min_agreement = 0.7;      ///< minimum correlation of image and template
  double min_inlier_share = 0.35;  ///< minimum share of inliers among the samples in view
  double max_sigma_px = 1;         ///< maximum standard deviation of the most uncertain corner
  void check() const;
};
void visit(OptionVisitor& field, AlignOptions& options);

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
