#include <placegraph/frontend/vanishing/vanishing_model.h>
#include <placegraph/frontend/vanishing/vanishing_points.h>
#include <placegraph/frontend/vanishing/vanishing_search.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace placegraph {
namespace {

/// Removes directions as long as the cost decreases: those that others have made redundant.
void shrink(VanishingModel& model) {
  for (int z = model.size() - 1; z >= 0; --z) {
    if (z >= model.size()) continue;
    VanishingModel smaller = model.without(z, 1);
    if (smaller.cost() <= model.cost()) model = std::move(smaller);
  }
}

}  // namespace

VanishingPoints vanishing_points(const VanishingEvidence& evidence, const VanishingModel& model,
                                 std::vector<int>& order) {
  std::vector<VanishingPoint> points;
  for (int z = 0; z < model.size(); ++z) {
    const FittedDirection& direction = model.directions()[static_cast<std::size_t>(z)];
    points.push_back({direction.v, direction.covariance, static_cast<int>(model.lines_of(z).size()),
                      model.without(z, 0).cost() - model.cost()});
  }
  order.resize(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto evidence_of = [&](int z) { return points[static_cast<std::size_t>(z)].evidence; };
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return evidence_of(a) > evidence_of(b); });
  VanishingPoints result;
  result.outcome = Outcome::ok();
  result.noise = evidence.noise();
  std::vector<int> rank(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    result.points.push_back(points[static_cast<std::size_t>(order[k])]);
    rank[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
  }
  for (const int z : model.of())
    result.labels.push_back(z < 0 ? -1 : rank[static_cast<std::size_t>(z)]);
  return result;
}

VanishingPoints find_vanishing_points(VanishingEvidence& evidence,
                                      const VanishingPointOptions& options, Random& random) {
  options.check();
  VanishingPoints result;
  result.labels.assign(static_cast<std::size_t>(evidence.size()), -1);
  result.noise = evidence.noise();
  if (evidence.size() < options.min_segments) {
    result.outcome = Outcome::failure(Outcome::Code::kTooFewData,
                                      std::to_string(evidence.size()) + " segments, " +
                                          std::to_string(options.min_segments) + " needed");
    return result;
  }
  VanishingModel model(evidence, kPointCost_nats, options.min_segments);
  VanishingSearch search(evidence, options.samples, random);
  search.grow(model, options.max_points);
  for (int round = 0; round < 2 && model.size() > 0; ++round) {
    std::vector<Eigen::Vector3d> directions;
    for (const FittedDirection& direction : model.directions()) directions.push_back(direction.v);
    evidence.fit_noise(directions, model.of());
    model.polish(2);
    if (round == 0) {
      search.refresh();
      search.grow(model, options.max_points);
    }
    shrink(model);
  }
  result.noise = evidence.noise();
  if (model.size() == 0) {
    result.outcome = Outcome::failure(
        Outcome::Code::kNoConsensus,
        "no direction is common to enough of the " + std::to_string(evidence.size()) + " segments");
    return result;
  }
  std::vector<int> order;
  return vanishing_points(evidence, model, order);
}

VanishingPoints find_vanishing_points(const std::vector<LineSegment>& segments,
                                      const Camera& camera, const VanishingPointOptions& options,
                                      Random& random) {
  VanishingEvidence evidence(segments, camera, options.noise);
  VanishingPoints result = find_vanishing_points(evidence, options, random);
  spread_labels(evidence, segments.size(), result.labels);
  return result;
}

}  // namespace placegraph
