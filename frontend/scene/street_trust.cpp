#include <placegraph/frontend/scene/street_trust.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>

namespace placegraph {

double street_probability(const EnvironmentProbabilities& kinds) {
  double sum = 0;
  for (std::size_t k = 0; k < kEnvironmentCount; ++k)
    if (assumptions_of(static_cast<Environment>(k)).street_surfaces) sum += kinds[k];
  return sum;
}

std::vector<EnvironmentProbabilities> smoothed_kinds(
    const std::vector<EnvironmentProbabilities>& views, const EnvironmentFilterOptions& options) {
  EnvironmentFilter before(options), after(options);
  std::vector<EnvironmentProbabilities> ahead;  // by all later views
  for (std::size_t i = views.size(); i-- > 0; after.add(views[i]))
    ahead.push_back(after.probabilities());
  std::reverse(ahead.begin(), ahead.end());
  const double change = (1 - options.stay) / (kEnvironmentCount - 1);
  std::vector<EnvironmentProbabilities> smoothed;
  for (std::size_t i = 0; i < views.size(); ++i) {
    before.add(views[i]);
    EnvironmentProbabilities& kinds = smoothed.emplace_back();
    double sum = 0;
    for (std::size_t k = 0; k < kEnvironmentCount; ++k)
      sum += kinds[k] =
          before.probabilities()[k] * (change + (options.stay - change) * ahead[i][k]);
    for (double& kind : kinds) kind /= sum;
  }
  return smoothed;
}

SceneLabels street_labels(const std::vector<float>& probabilities, int classes,
                          const SceneView& view, double street, double unknown_below) {
  require(street >= 0 && street <= 1, "street_labels: a probability is needed");
  // Above any probability.
  constexpr double kNever = 2;
  const double least = street > 0 ? (1 - street) / street : kNever;  // street P(c) >= 1 - street
  return most_probable(probabilities, classes, view, std::max(least, unknown_below));
}

}  // namespace placegraph
