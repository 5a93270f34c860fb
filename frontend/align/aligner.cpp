#include <placegraph/frontend/align/aligner.h>
#include <placegraph/frontend/align/alignment_covariance.h>
#include <placegraph/frontend/flow/grey_pyramid.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace placegraph {
namespace {

using Code = Outcome::Code;
using End = GradientAlignmentResult::End;

/// Inputs of an alignment.
struct Job {
  const PlanarTemplate& planar_template;
  const std::vector<Image>& pyramid;
  const AlignOptions& options;
  int coarsest = 0;
};

using Corners = std::array<Eigen::Vector2d, 4>;
using Matrix8d = Eigen::Matrix<double, 8, 8>;

bool is_population(AlignOptimizer optimizer) {
  return optimizer == AlignOptimizer::kSwarm || optimizer == AlignOptimizer::kGenetic;
}

Gradients gradients_of(AlignOptimizer optimizer) {
  switch (optimizer) {
    case AlignOptimizer::kGaussNewton:
      return Gradients::kForward;
    case AlignOptimizer::kInverseCompositional:
      return Gradients::kInverse;
    default:
      return Gradients::kEsm;
  }
}

/// A uniformly drawn subset of a level's samples, the same in every run.
TemplateLevel thinned(const TemplateLevel& level, int count) {
  const int all = static_cast<int>(level.samples.size());
  if (all <= count) return level;
  TemplateLevel part{{}, level.columns, level.rows};
  std::vector<int> chosen;
  Random(1).sample(all, count, chosen);
  std::sort(chosen.begin(), chosen.end());
  for (const int i : chosen) part.samples.push_back(level.samples[static_cast<std::size_t>(i)]);
  return part;
}

/// Similarity of a warp on some samples; -infinity where too few of them are in view.
double similarity_at(const Job& job, const TemplateLevel& samples, int level,
                     const Eigen::Matrix3d& H_cur_ref, bool robust) {
  SeenSamples seen;
  see_samples(samples, job.planar_template, job.pyramid[static_cast<std::size_t>(level)], level,
              H_cur_ref, false, seen);
  const GradientAlignmentOptions& o = job.options.gradient;
  if (static_cast<double>(seen.index.size()) <
      o.min_visible_share * static_cast<double>(samples.samples.size()))
    return -std::numeric_limits<double>::infinity();
  return robust ? robust_similarity(o.similarity, seen.ref, seen.cur)
                : similarity(o.similarity, seen.ref, seen.cur);
}

/// Covariance of the corners at the start of a search: independent offsets of search_sigma and a
/// common one of search_shift_sigma, both times `reach_px`.
Matrix8d corner_spread(const AlignOptions& o, double reach_px) {
  Matrix8d spread = o.search_sigma * o.search_sigma * Matrix8d::Identity();
  for (int i = 0; i < 8; ++i)
    for (int j = i % 2; j < 8; j += 2) spread(i, j) += o.search_shift_sigma * o.search_shift_sigma;
  return reach_px * reach_px * spread;
}

/// Maps a member's coordinates, in standard deviations, to a warp about `start`.
///
/// A warp of 8 degrees of freedom is computed exactly from its corners; in other families the
/// corners move to first order. Nothing if no camera can take such an image of the template.
std::function<std::optional<PlanarWarp>(const Eigen::VectorXd&)> members_about(
    const Job& job, const PlanarWarp& start, double reach_px) {
  const Matrix8d spread = corner_spread(job.options, reach_px);
  const auto& corners_px = job.planar_template.corners_px();
  if (start.kind() == PlanarWarp::Kind::kHomography) {
    Corners at;
    for (std::size_t c = 0; c < 4; ++c) at[c] = *map_pixel(start.H_cur_ref(), corners_px[c]);
    const Matrix8d root = spread.llt().matrixL();
    return [=](const Eigen::VectorXd& z) -> std::optional<PlanarWarp> {
      const Eigen::Matrix<double, 8, 1> offset = root * z;
      Corners moved = at;
      for (int c = 0; c < 4; ++c) moved[static_cast<std::size_t>(c)] += offset.segment<2>(2 * c);
      const auto H_cur_ref = homography_of_box(corners_px, moved);
      if (!H_cur_ref) return std::nullopt;
      return start.at(*H_cur_ref);
    };
  }
  const auto J = job.planar_template.corner_jacobian(start);
  const Eigen::LLT<Eigen::MatrixXd> llt(J.transpose() * spread.llt().solve(J));
  if (llt.info() != Eigen::Success) return [](const Eigen::VectorXd&) { return std::nullopt; };
  const Eigen::MatrixXd upper = llt.matrixU();
  return [=](const Eigen::VectorXd& z) -> std::optional<PlanarWarp> {
    return start.plus(upper.triangularView<Eigen::Upper>().solve(z));
  };
}

/// Warps found by a population about `start`, best first.
std::vector<PlanarWarp> search(const Job& job, const PlanarWarp& start, int level, double reach_px,
                               int& evaluations) {
  const AlignOptions& o = job.options;
  const auto member = members_about(job, start, reach_px);
  const TemplateLevel samples =
      thinned(job.planar_template.levels()[static_cast<std::size_t>(level)], o.search_samples);
  const PopulationCost cost = [&](const Eigen::VectorXd& z) {
    const auto warp = member(z);
    if (!warp) return std::numeric_limits<double>::infinity();
    return -similarity_at(job, samples, level, warp->H_cur_ref(), false);
  };
  const PopulationResult found = o.optimizer == AlignOptimizer::kGenetic
                                     ? genetic_search(cost, start.dof(), o.genetic)
                                     : swarm_search(cost, start.dof(), o.swarm);
  evaluations += found.evaluations;
  std::vector<PlanarWarp> warps;
  for (std::size_t i = 0; i < found.points.size(); ++i)
    if (std::isfinite(found.costs[i])) warps.push_back(*member(found.points[i]));
  return warps;
}

GradientAlignmentResult follow(const Job& job, const PlanarWarp& start, int level) {
  return align_level(job.planar_template, job.pyramid[static_cast<std::size_t>(level)], level,
                     start, gradients_of(job.options.optimizer), job.options.gradient);
}

/// The best result of ESM from the start and from the best members that are not neighbours.
PlanarWarp follow_members(const Job& job, const PlanarWarp& start,
                          const std::vector<PlanarWarp>& members, AlignResult& result) {
  const TemplateLevel& samples =
      job.planar_template.levels()[static_cast<std::size_t>(job.coarsest)];
  const double apart_px = std::ldexp(1.0, job.coarsest);
  std::vector<PlanarWarp> starts{start};
  for (const PlanarWarp& member : members) {
    if (static_cast<int>(starts.size()) > job.options.followed) break;
    bool fresh = true;
    for (const PlanarWarp& other : starts)
      fresh = fresh && job.planar_template.corner_distance_px(member.H_cur_ref(),
                                                              other.H_cur_ref()) > apart_px;
    if (fresh) starts.push_back(member);
  }
  PlanarWarp best = start;
  double best_similarity = -std::numeric_limits<double>::infinity();
  for (const PlanarWarp& candidate : starts) {
    const GradientAlignmentResult end = follow(job, candidate, job.coarsest);
    result.iterations += end.iterations;
    const double value = similarity_at(job, samples, job.coarsest, end.warp.H_cur_ref(), true);
    if (!(value > best_similarity)) continue;
    best_similarity = value;
    best = end.warp;
  }
  return best;
}

/// Aligns coarse to fine; false, with an outcome, if the alignment failed.
bool descend(const Job& job, AlignResult& result) {
  const AlignOptions& o = job.options;
  double reach_px = job.planar_template.diagonal_px();
  for (int level = job.coarsest; level >= 0; --level, reach_px /= 4) {
    const bool searched = is_population(o.optimizer) ||
                          (o.optimizer == AlignOptimizer::kSwarmEsm && level == job.coarsest);
    if (searched) {
      const auto members = search(job, result.warp, level, reach_px, result.evaluations);
      if (is_population(o.optimizer)) {
        if (members.empty()) {
          result.outcome = Outcome::failure(Code::kTooFewData, "the template is out of view");
          return false;
        }
        result.warp = members.front();
        continue;
      }
      result.warp = follow_members(job, result.warp, members, result);
    }
    const GradientAlignmentResult end = follow(job, result.warp, level);
    result.warp = end.warp;
    result.iterations += end.iterations;
    result.last_step_px = end.last_step_px;
    result.visible_share = end.visible_share;
    if (end.end == End::kOutOfView) {
      result.outcome = Outcome::failure(Code::kTooFewData, "the template is out of view");
      return false;
    }
    if (end.end == End::kSingular && level == 0) {
      result.outcome =
          Outcome::failure(Code::kNotConverged, "the samples in view do not determine a step");
      return false;
    }
  }
  return true;
}

/// Fills in the quality measures on the finest level.
void measure(const Job& job, AlignResult& result) {
  const TemplateLevel& samples = job.planar_template.levels()[0];
  const GradientAlignmentOptions& o = job.options.gradient;
  SeenSamples seen;
  see_samples(samples, job.planar_template, job.pyramid[0], 0, result.warp.H_cur_ref(), false,
              seen);
  result.visible_share =
      static_cast<double>(seen.index.size()) / static_cast<double>(samples.samples.size());
  if (seen.index.size() < 2) return;
  PhotometricFit fit;
  fit_photometry(o.similarity, seen.ref, seen.cur, o.kernel, o.kernel_width, fit);
  result.similarity = fit.similarity;
  result.agreement = agreement(fit, seen.cur);
  result.inlier_share = fit.inlier_share;
  result.robust_similarity = robust_similarity(
      o.similarity == Similarity::kMi ? Similarity::kZncc : o.similarity, seen.ref, seen.cur);
  result.gain = fit.gain, result.bias = fit.bias;
  const auto covariance =
      alignment_covariance(job.planar_template, job.pyramid[0], 0, result.warp, o);
  result.corner_sigma_px = std::numeric_limits<double>::infinity();
  if (!covariance) return;
  result.covariance = covariance->covariance;
  result.independent_share = covariance->independent_share;
  result.corner_sigma_px =
      corner_sigma_px(job.planar_template, result.warp, covariance->covariance);
}

Outcome judge(const AlignResult& result, const AlignOptions& o) {
  if (result.visible_share < o.gradient.min_visible_share)
    return Outcome::failure(Code::kTooFewData, "the template is out of view");
  if (result.agreement < o.min_agreement)
    return Outcome::failure(Code::kInconsistent, "correlation " + std::to_string(result.agreement));
  if (result.inlier_share < o.min_inlier_share)
    return Outcome::failure(Code::kInconsistent,
                            "share of inliers " + std::to_string(result.inlier_share));
  // A last step of a pixel: no minimum was reached. Chosen.
  constexpr double kUnsettledPx = 1;
  if (result.last_step_px > std::min(o.max_sigma_px, kUnsettledPx))
    return Outcome::failure(Code::kNotConverged,
                            "last step " + std::to_string(result.last_step_px) + " px");
  if (!(result.corner_sigma_px <= o.max_sigma_px))
    return Outcome::failure(Code::kDegenerate,
                            "a corner uncertain by " + std::to_string(result.corner_sigma_px));
  return Outcome::ok();
}

}  // namespace

AlignResult align(const PlanarTemplate& planar_template, const Image& image_cur,
                  const PlanarWarp& start, const AlignOptions& options) {
  return align(planar_template,
               grey_pyramid(image_cur, static_cast<int>(planar_template.levels().size())), start,
               options);
}

AlignResult align(const PlanarTemplate& planar_template, const std::vector<Image>& pyramid_cur,
                  const PlanarWarp& start, const AlignOptions& options) {
  options.check();
  require(!pyramid_cur.empty(), "align: a pyramid without levels");
  const auto& levels = planar_template.levels();
  AlignResult result;
  result.warp = start;
  if (static_cast<int>(levels[0].samples.size()) < options.min_samples) {
    result.outcome = Outcome::failure(
        Code::kTooFewData, "a template of " + std::to_string(levels[0].samples.size()) + " pixels");
    return result;
  }
  for (const Eigen::Vector2d& corner : planar_template.corners_px()) {
    if (map_pixel(start.H_cur_ref(), corner)) continue;
    result.outcome = Outcome::failure(Code::kTooFewData, "the template starts beyond the horizon");
    return result;
  }
  // Noise of two grey levels, one independent sample in ten. The start warp is irrelevant here.
  const PlanarWarp unmoved = start.at(Eigen::Matrix3d::Identity());
  const double promised_px =
      promised_corner_sigma_px(planar_template, 0, unmoved, 2 * std::sqrt(10.0));
  if (!(promised_px <= options.max_sigma_px)) {
    result.corner_sigma_px = promised_px;
    result.outcome = Outcome::failure(Code::kDegenerate, "the template has too little texture");
    return result;
  }
  Job job{planar_template, pyramid_cur, options};
  const int most = static_cast<int>(std::min(levels.size(), job.pyramid.size()));
  while (job.coarsest + 1 < most &&
         static_cast<int>(levels[static_cast<std::size_t>(job.coarsest) + 1].samples.size()) >=
             options.min_samples)
    ++job.coarsest;
  if (!descend(job, result)) return result;
  measure(job, result);
  result.outcome = judge(result, options);
  return result;
}

}  // namespace placegraph
