#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/core/ransac_options.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace placegraph {

/// Number of samples of which one is free of outliers with probability `confidence` (Fischler &
/// Bolles 1981); at least 1, at most `max`.
int ransac_iterations(double inlier_ratio, int sample_size, double confidence, int max);

template <class Model>
struct RansacResult {
  Outcome outcome;
  Model model;               ///< meaningful only if outcome
  std::vector<int> inliers;  ///< indices, ascending
  double score = 0;          ///< MSAC cost of the model
  int iterations = 0;
};

/// MSAC (Torr & Zisserman 2000) over minimal samples, with non-minimal refinement on the inliers of
/// the previous model whenever a better model is found: while the score decreases, at most four
/// times (local optimization, Chum et al. 2003). Deterministic for a given `random`. OpenCV's
/// robust estimators are limited to their own models, and OpenGV's counts inliers and has its own
/// random generator; here the caller supplies model, error, refinement and random generator.
///
/// `solve(sample) -> std::vector<Model>` from `sample_size` indices;
/// `squared_error(model, i) -> double`, to be compared with `threshold_squared`;
/// `refine(model, inliers) -> Model` (return the model itself for none).
template <class Model, class Solve, class SquaredError, class Refine>
RansacResult<Model> ransac(int n, int sample_size, double threshold_squared,
                           const RansacOptions& options, Random& random, Solve&& solve,
                           SquaredError&& squared_error, Refine&& refine) {
  // Rounds of refinement at most. Chosen.
  constexpr int kRefinements = 4;
  RansacResult<Model> best;
  best.score = threshold_squared * n;
  if (n < std::max(sample_size, options.min_inliers)) {
    best.outcome = Outcome::failure(Outcome::Code::kTooFewData,
                                    std::to_string(n) + " measurements, " +
                                        std::to_string(std::max(sample_size, options.min_inliers)) +
                                        " needed");
    return best;
  }
  const auto consider = [&](const Model& model) {
    double score = 0;
    for (int i = 0; i < n && score < best.score; ++i) {
      const double e = squared_error(model, i);
      score += e < threshold_squared ? e : threshold_squared;  // NaN counts as an outlier
    }
    if (!(score < best.score)) return false;
    best.score = score;
    best.model = model;
    best.inliers.clear();
    for (int i = 0; i < n; ++i)
      if (squared_error(model, i) < threshold_squared) best.inliers.push_back(i);
    return true;
  };
  std::vector<int> sample;
  int needed = options.max_iterations;
  for (best.iterations = 0; best.iterations < needed; ++best.iterations) {
    check_interruption();
    random.sample(n, sample_size, sample);
    bool improved = false;
    for (const Model& model : solve(sample)) improved |= consider(model);
    if (!improved) continue;
    // The inliers of a minimal model are a biased choice; those of the refined model are less
    // biased.
    for (int round = 0; round < kRefinements; ++round)
      if (static_cast<int>(best.inliers.size()) <= sample_size ||
          !consider(refine(best.model, best.inliers)))
        break;
    needed = ransac_iterations(static_cast<double>(best.inliers.size()) / n, sample_size,
                               options.confidence, options.max_iterations);
  }
  best.outcome = static_cast<int>(best.inliers.size()) >= options.min_inliers
                     ? Outcome::ok()
                     : Outcome::failure(Outcome::Code::kNoConsensus,
                                        std::to_string(best.inliers.size()) + " inliers of " +
                                            std::to_string(n) + ", " +
                                            std::to_string(options.min_inliers) + " needed");
  return best;
}

}  // namespace placegraph
