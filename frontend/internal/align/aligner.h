#pragma once
#include <placegraph/frontend/internal/align/genetic_search.h>
#include <placegraph/frontend/internal/align/gradient_alignment.h>
#include <placegraph/graph/core/outcome.h>

namespace placegraph {

enum class AlignOptimizer {
  kGaussNewton,           ///< forward compositional
  kEsm,                   ///< efficient second-order minimization
  kInverseCompositional,  ///< the template's gradients only
  kSwarm,                 ///< particle swarm
  kGenetic,               ///< genetic algorithm
  kSwarmEsm,              ///< particle swarm, its best members followed by ESM
};
const std::vector<std::string>& align_optimizer_names();

struct AlignOptions {
  AlignOptimizer optimizer = AlignOptimizer::kEsm;
  GradientAlignmentOptions gradient;  ///< its similarity is that of the searches as well
  /// Of a corner's coordinate where a population starts on the coarsest level, in diagonals of the
  /// template; on every finer level a quarter of the one before.
  double search_sigma = 0.18;
  /// Of a shift of all corners together on top of that, in the same unit: where the template may
  /// have gone far without having changed its shape as much.
  double search_shift_sigma = 0;
  int search_samples = 400;  ///< the similarity of a member is that of so many samples
  int followed = 8;          ///< best members of the swarm that ESM follows
  SwarmOptions swarm;
  GeneticOptions genetic;
  int min_samples = 100;           ///< of the template: a coarse level with fewer is left out
  double min_agreement = 0.7;      ///< correlation of image and template below which it is no match
  double min_inlier_share = 0.35;  ///< of the samples in view
  double max_sigma_px = 1;         ///< of the most uncertain corner
  void check() const;
};
void visit(OptionVisitor& field, AlignOptions& options);

struct AlignResult {
  Outcome outcome;
  PlanarWarp warp;             ///< where it ended; to be used only if outcome
  Eigen::MatrixXd covariance;  ///< of the warp's right tangent, see alignment_covariance
  double corner_sigma_px = 0;  ///< of the most uncertain corner
  double independent_share = 0;
  double similarity = 0;  ///< on the finest level
  double agreement = 0;   ///< weighted correlation of the image and what the template predicts
  double robust_similarity = 0;  ///< robust_similarity on the finest level, of ZNCC under MI
  double visible_share = 0;      ///< of the samples
  double inlier_share = 0;       ///< of those in view
  double gain = 1, bias = 0;
  double last_step_px = 0;
  int iterations = 0;   ///< along derivatives, all levels and members
  int evaluations = 0;  ///< of members of a population
};

/// Finds a planar template in an image: the warp of start's family that makes the similarity
/// greatest, coarse to fine over the levels of the template. Outcomes: too few data (the template
/// has less than min_samples, or less than min_visible_share of it is in view), degenerate (too
/// little texture: a corner would stay uncertain by more than max_sigma_px), not converged (the
/// last step moved a corner by more than max_sigma_px or a pixel, or could not be told),
/// inconsistent (what was found does not look like the template).
[[nodiscard]] AlignResult align(const PlanarTemplate& planar_template, const Image& image_cur,
                                const PlanarWarp& start, const AlignOptions& options);
/// The same in an image whose grey_pyramid is at hand.
[[nodiscard]] AlignResult align(const PlanarTemplate& planar_template,
                                const std::vector<Image>& pyramid_cur, const PlanarWarp& start,
                                const AlignOptions& options);

}  // namespace placegraph
