#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/places/place_optimizer.h>

namespace placegraph {

PlaceOptimizer::PlaceOptimizer(const IncrementalOptions& options)
    : options_(options), optimizer_(options) {}

std::optional<PoseKind> PlaceOptimizer::kind() const { return optimizer_.kind(); }

void PlaceOptimizer::reset() {
  optimizer_ = IncrementalOptimizer(options_);
  tracked_.clear();
}

IncrementalStep PlaceOptimizer::begin(const std::vector<PoseNode>& places,
                                      const std::vector<PlaceConstraint>& constraints) {
  PoseGraph graph;
  graph.nodes = places;
  tracked_.clear();
  for (const PlaceConstraint& constraint : constraints) {
    if (!constraint.measured) continue;
    tracked_[constraint.key] = {static_cast<int>(graph.constraints.size()),
                                constraint.measured->from, constraint.measured->to};
    graph.constraints.push_back(*constraint.measured);
  }
  optimizer_ = IncrementalOptimizer(options_, graph);
  return optimizer_.apply({});
}

IncrementalStep PlaceOptimizer::follow(const std::vector<PoseNode>& places,
                                       const std::vector<PlaceConstraint>& constraints) {
  GraphChange change;
  change.nodes = places;
  std::vector<PlaceConstraint::Key> added;
  for (const PlaceConstraint& constraint : constraints) {
    const auto tracked = tracked_.find(constraint.key);
    const auto& measured = constraint.measured;
    if (tracked != tracked_.end()) {
      const auto& [number, from, to] = tracked->second;
      if (measured && measured->from == from && measured->to == to) {
        change.revised.push_back({number, *measured});
        continue;
      }
      change.weights.push_back({number, 0});
      tracked_.erase(tracked);
    }
    if (!measured) continue;
    change.constraints.push_back(*measured);
    added.push_back(constraint.key);
  }
  const IncrementalStep step = optimizer_.apply(change);
  for (std::size_t i = 0; i < added.size(); ++i) {
    const auto& measured = std::get<RelativePoseConstraint>(change.constraints[i]);
    tracked_[added[i]] = {step.first_constraint + static_cast<int>(i), measured.from, measured.to};
  }
  return step;
}

Sim3 PlaceOptimizer::S_map_place(PlaceId place) const {
  const auto pose = optimizer_.pose(node_of_place(place));
  require(pose.has_value(), "PlaceOptimizer: unknown place " + to_string(place));
  if (const auto* S = std::get_if<Sim3>(&*pose)) return *S;
  return Sim3(std::get<SE3>(*pose));
}

Matrix7d PlaceOptimizer::relative_covariance(PlaceId from, PlaceId to) const {
  const Information of_pose =
      optimizer_.relative_covariance(node_of_place(from), node_of_place(to));
  Matrix7d covariance = Matrix7d::Zero();
  covariance.topLeftCorner(of_pose.rows(), of_pose.cols()) = of_pose;
  return covariance;
}

}  // namespace placegraph
