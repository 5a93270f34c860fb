#include <placegraph/frontend/cloud_planes/planarity_model.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace placegraph {

const std::array<const char*, kPlanarityFeatures>& planarity_feature_names() {
  static constexpr std::array<const char*, kPlanarityFeatures> kNames = {
      "misfit", "linearity", "scatter", "near",   "far",   "curved", "bend", "turn",
      "alike",  "goes_on",   "gentle",  "crease", "rough", "border", "size"};
  return kNames;
}

double PlanarityModel::probability(const PlanarityFeatures& features) const {
  double votes = 0;
  for (const Stump& stump : stumps)
    votes += features[static_cast<std::size_t>(stump.feature)] < stump.threshold ? stump.below
                                                                                 : stump.above;
  return 1 / (1 + std::exp(-2 * votes));
}

PlanarityModel train_planarity(const std::vector<PlanaritySample>& samples, int rounds) {
  const std::size_t n = samples.size();
  std::size_t planes = 0;
  for (const PlanaritySample& sample : samples) planes += sample.planar;
  require(planes > 0 && planes < n, "planarity: needs samples of both kinds");
  std::vector<double> weight(n), target(n);
  for (std::size_t i = 0; i < n; ++i) {
    target[i] = samples[i].planar ? 1 : -1;
    weight[i] = 0.5 / static_cast<double>(samples[i].planar ? planes : n - planes);
  }
  std::array<std::vector<std::size_t>, kPlanarityFeatures> order;
  for (std::size_t f = 0; f < order.size(); ++f) {
    order[f].resize(n);
    std::iota(order[f].begin(), order[f].end(), 0);
    std::stable_sort(order[f].begin(), order[f].end(), [&](std::size_t a, std::size_t b) {
      return samples[a].features[f] < samples[b].features[f];
    });
  }
  PlanarityModel model;
  for (int round = 0; round < rounds; ++round) {
    double all = 0, sum = 0;
    for (std::size_t i = 0; i < n; ++i) all += weight[i], sum += weight[i] * target[i];
    PlanarityModel::Stump best{0, 0, sum / all, sum / all};
    double most = 0;  // largest reduction of the squared error by a stump
    for (std::size_t f = 0; f < order.size(); ++f) {
      double w = 0, s = 0;
      for (std::size_t k = 0; k + 1 < n; ++k) {
        const std::size_t i = order[f][k];
        w += weight[i], s += weight[i] * target[i];
        const double here = samples[i].features[f], next = samples[order[f][k + 1]].features[f];
        if (!(next > here)) continue;
        const double gain = s * s / w + (sum - s) * (sum - s) / (all - w);
        if (!(gain > most)) continue;
        most = gain;
        best = {static_cast<int>(f), (here + next) / 2, s / w, (sum - s) / (all - w)};
      }
    }
    model.stumps.push_back(best);
    for (std::size_t i = 0; i < n; ++i) {
      const bool below =
          samples[i].features[static_cast<std::size_t>(best.feature)] < best.threshold;
      weight[i] *= std::exp(-target[i] * (below ? best.below : best.above));
    }
    const double total = std::accumulate(weight.begin(), weight.end(), 0.0);
    for (double& w : weight) w /= total;
  }
  return model;
}

}  // namespace placegraph
