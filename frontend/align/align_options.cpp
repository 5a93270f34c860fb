#include <placegraph/frontend/align/align_options.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {

const std::vector<std::string>& similarity_names() {
  static const std::vector<std::string> names = {"ssd", "ssd_gain_bias", "zncc", "mi"};
  return names;
}

const std::vector<std::string>& align_optimizer_names() {
  static const std::vector<std::string> names = {"gauss_newton", "esm",     "inverse_compositional",
                                                 "swarm",        "genetic", "swarm_esm"};
  return names;
}

const std::vector<std::string>& plane_model_names() {
  static const std::vector<std::string> names = {"homography", "se3plane", "se2plane"};
  return names;
}

void GeneticOptions::check() const {
  check_ranges(*this);
  require(elite < members, "elite: must be below members");
}

void visit(OptionVisitor& field, GeneticOptions& o) {
  field("members", o.members, "size of the population", {3, 10000});
  field("generations", o.generations, "maximum number of generations", {1, 10000});
  field("stagnation", o.stagnation, "generations without progress after which the search ends",
        {1, 10000});
  field("tournament", o.tournament, "members drawn for a parent", {1, 100});
  field("elite", o.elite, "best members kept unchanged", {0, 1000});
  field("blend", o.blend, "share by which the box of children exceeds that of the parents", {0, 2});
  field("mutation_rate", o.mutation_rate, "probability that a coordinate mutates", {0, 1});
  field("mutation_sigma", o.mutation_sigma,
        "initial size of mutations [standard deviations of the start]", {0, 10});
  field("bound", o.bound,
        "largest absolute value of a coordinate [standard deviations of the start]", {0.1, 100});
  field("seed", o.seed, "seed of the random stream");
  field("threads", o.threads, "threads; the result does not depend on it", {1, 256});
}

void GradientAlignmentOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, GradientAlignmentOptions& o) {
  field.choice("similarity", o.similarity, similarity_names(),
               "similarity measure that is maximized");
  field.choice("kernel", o.kernel, robust_kernel_names(), "robust kernel against occlusion");
  field("kernel_width", o.kernel_width,
        "width of the robust kernel [standard deviations of the residuals]", {0.1, 100});
  field("iterations", o.iterations, "maximum number of iterations per level", {1, 1000});
  field("converged_px", o.converged_px, "a level ends when no corner moves by more in a step [px]",
        {1e-6, 1});
  field("min_visible_share", o.min_visible_share,
        "minimum share of the samples in view of the current image", {0.05, 1});
}

void AlignOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, AlignOptions& o) {
  field.choice("optimizer", o.optimizer, align_optimizer_names(), "optimizer of the warp");
  field.group("gradient", o.gradient, "similarity and gradient-based optimizers");
  field("search_sigma", o.search_sigma,
        "initial standard deviation of a population's corners [template diagonals]", {0.001, 2});
  field("search_shift_sigma", o.search_shift_sigma,
        "standard deviation of a common shift of all corners [template diagonals]", {0, 10});
  field("search_samples", o.search_samples,
        "samples from which the similarity of a member is computed", {20, 1000000});
  field("followed", o.followed, "best members of the swarm that ESM follows", {1, 1000});
  field.group("swarm", o.swarm, "particle swarm");
  field.group("genetic", o.genetic, "genetic algorithm");
  field("min_samples", o.min_samples, "minimum samples of a level", {20, 1000000});
  field("min_agreement", o.min_agreement, "minimum correlation of image and template", {-1, 1});
  field("min_inlier_share", o.min_inlier_share,
        "minimum share of inliers among the samples in view", {0, 1});
  field("max_sigma_px", o.max_sigma_px,
        "maximum standard deviation of the most uncertain corner [px]", {0.001, 100});
}

void PlaneTrackerOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaneTrackerOptions& o) {
  field.group("align", o.align, "alignment of the template");
  field.choice("model", o.model, plane_model_names(), "motion model of the template");
  field("levels", o.levels, "number of levels of the image pyramid", {1, 10});
  field("max_samples", o.max_samples, "maximum samples of a level", {100, 10000000});
  field("chance_trials", o.chance_trials,
        "surrogate images for the null distribution of the similarity", {2, 1000});
  field("chance_deviations", o.chance_deviations,
        "minimum deviations of the similarity above the null distribution's mean", {0, 20});
  field("rival_margin", o.rival_margin,
        "minimum similarity of a found template above its repetitions in the image", {0, 1});
  field("max_area_change", o.max_area_change,
        "maximum factor of the area between frames, in both directions", {1, 100});
  field("min_area_px", o.min_area_px, "minimum area of the template's image [px^2]", {1, 1e9});
  field("search_sigma", o.search_sigma,
        "standard deviation of corners in the search [template diagonals]", {0.001, 2});
  field("search_shift", o.search_shift,
        "standard deviation of a common shift in the search [template diagonals]", {0, 10});
  field("back_px", o.back_px, "maximum forward-backward error of a template found again [px]",
        {0.01, 100});
  field.group("finder", o.finder, "search by point features");
  field.formerly("key_likeness")("key_similarity", o.key_similarity,
                                 "minimum similarity of a view that becomes the second template",
                                 {0, 1});
  field("key_interval", o.key_interval, "minimum number of frames between second templates",
        {1, 1000000});
  field.group("normal", o.normal, "the plane's normal from several views");
}

}  // namespace placegraph
