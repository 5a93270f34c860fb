#pragma once
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/ransac_options.h>
#include <placegraph/graph/core/robust_kernel.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Measure of the similarity of two lists of grey values.
enum class Similarity {
  kSsd,          ///< sum of squared differences
  kSsdGainBias,  ///< sum of squared differences after the best gain (1/2 to 2) and bias
  kZncc,         ///< zero-mean normalized cross-correlation
  kMi,           ///< mutual information of a joint histogram with cubic B-spline windows
};

/// Optimizer of the warp of a planar template.
enum class AlignOptimizer {
  kGaussNewton,           ///< forward compositional
  kEsm,                   ///< efficient second-order minimization
  kInverseCompositional,  ///< the template's gradients only
  kSwarm,                 ///< particle swarm
  kGenetic,               ///< genetic algorithm
  kSwarmEsm,              ///< particle swarm, its best members followed by ESM
};

/// Motion model of the template; all but the first need a camera.
enum class PlaneModel {
  kHomography,  ///< 8 degrees of freedom
  kSe3Plane,    ///< a rigid motion before the plane, whose normal must be known first
  kSe2Plane,    ///< a motion along the plane
};

/// Names of the similarities, in their order.
const std::vector<std::string>& similarity_names();

/// Names of the optimizers, in their order.
const std::vector<std::string>& align_optimizer_names();

/// Names of the motion models, in their order.
const std::vector<std::string>& plane_model_names();

/// Options of the genetic search.
struct GeneticOptions {
  int members = 40;             ///< size of the population
  int generations = 40;         ///< maximum number of generations
  int stagnation = 12;          ///< generations without a better best member that end the search
  int tournament = 3;           ///< members drawn for each parent; the best becomes the parent
  int elite = 2;                ///< best members kept unchanged
  double blend = 0.3;           ///< share by which the box of children exceeds that of the parents
  double mutation_rate = 0.2;   ///< probability that a coordinate mutates
  double mutation_sigma = 0.3;  ///< initial, in standard deviations of the start; decreases to
  ///< a tenth of that over the search
  double bound = 3;  ///< largest absolute value of a coordinate [standard deviations of the start]
  std::uint64_t seed = 1;  ///< seed of the random stream
  int threads = 1;         ///< the result does not depend on it
  void check() const;
};
void visit(OptionVisitor& field, GeneticOptions& options);

/// Options of the gradient-based alignment.
struct GradientAlignmentOptions {
  Similarity similarity = Similarity::kZncc;
  RobustKernel::Kind kernel = RobustKernel::Kind::kTukey;
  double kernel_width =
      4.685;            ///< width of the robust kernel [standard deviations of the residuals]
  int iterations = 20;  ///< maximum number of iterations per level
  double converged_px = 0.002;     ///< a level ends when no corner moves by more in a step
  double min_visible_share = 0.4;  ///< minimum share of the samples in view of the current image
  void check() const;
};
void visit(OptionVisitor& field, GradientAlignmentOptions& options);

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

/// Options of the plane tracker.
struct PlaneTrackerOptions {
  /// Alignment of the template from frame to frame. The covariance includes the uncertainty of a
  /// corner out of view, which is acceptable up to max_sigma_px.
  AlignOptions align = [] {
    AlignOptions options;
    options.max_sigma_px = 8;
    return options;
  }();
  PlaneModel model = PlaneModel::kHomography;
  int levels = 4;          ///< levels of the pyramid
  int max_samples = 3000;  ///< maximum samples of a level
  int chance_trials = 12;  ///< surrogate images for the null distribution
  double chance_deviations =
      4;  ///< least deviations of the similarity above the null distribution's mean
  double rival_margin = 0.1;  ///< once lost, least similarity above the template's repetitions
  double max_area_change =
      2;                     ///< maximum factor of the area of the template's image between frames
  double min_area_px = 100;  ///< minimum area of the template's image
  double search_sigma = 0.06;  ///< deviation of the corners in the search when lost [diagonals]
  double search_shift =
      0.3;  ///< common deviation of all corners [diagonals]; grows by half of it with
  ///< every further lost frame, up to the image's size
  double back_px = 2;  ///< maximum forward-backward error of a template found again
  TemplateFinderOptions finder;
  double key_similarity = 0.85;  ///< minimum similarity of a view that becomes the second template
  int key_interval = 5;          ///< minimum number of frames between second templates
  PlaneNormalOptions normal;
  void check() const;
};
void visit(OptionVisitor& field, PlaneTrackerOptions& options);

}  // namespace placegraph
