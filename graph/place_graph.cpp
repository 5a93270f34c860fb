#include <placegraph/graph/core/disjoint_sets.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/place_graph.h>
#include <placegraph/graph/pose_graph/node_index.h>

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

namespace placegraph {

const Place* PlaceGraph::find(PlaceId id) const {
  // Ids usually count from 0.
  const std::int64_t at = id.value();
  if (at >= 0 && at < static_cast<std::int64_t>(places.size()) && places[at].id == id)
    return &places[at];
  for (const Place& place : places)
    if (place.id == id) return &place;
  return nullptr;
}

std::vector<int> PlaceGraph::joined_components() const {
  DisjointSets sets(places.size());
  std::unordered_map<int, int> first_of_component;
  std::unordered_map<NodeId, int> index;
  for (int i = 0; i < static_cast<int>(places.size()); ++i) {
    sets.join(first_of_component.emplace(places[i].component, i).first->second, i);
    index.emplace(node_of_place(places[i].id), i);
  }
  for (const RelativePoseConstraint& constraint : constraints) {
    const auto from = index.find(constraint.from), to = index.find(constraint.to);
    if (from == index.end() || to == index.end())
      throw ArgumentError("place graph: constraint " + to_string(constraint.from) + " -> " +
                          to_string(constraint.to) + ": unknown place");
    sets.join(from->second, to->second);
  }
  std::vector<int> numbers = sets.numbers();
  std::map<int, int> smallest;
  for (std::size_t i = 0; i < places.size(); ++i) {
    int& number = smallest.emplace(numbers[i], places[i].component).first->second;
    number = std::min(number, places[i].component);
  }
  for (int& number : numbers) number = smallest.at(number);
  return numbers;
}

PoseGraph PlaceGraph::pose_graph() const {
  PoseGraph graph;
  const bool scaled =
      !constraints.empty() && kind_of(constraints.front().T_from_to) == PoseKind::kSim3;
  const std::vector<int> component = joined_components();
  std::set<int> seen;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool first = seen.insert(component[i]).second;
    const Pose pose = scaled ? Pose(places[i].S_map_place()) : Pose(places[i].T_map_place);
    graph.nodes.push_back({node_of_place(places[i].id), pose, first});
  }
  graph.constraints.assign(constraints.begin(), constraints.end());
  return graph;
}

void PlaceGraph::set_poses(const PoseGraph& optimized) {
  const NodeIndex index = optimized.index_by_id();
  for (Place& place : places) {
    const std::optional<int> node = index.find(node_of_place(place.id));
    if (!node)
      throw ArgumentError("place graph: the pose graph lacks place " + to_string(place.id));
    const Pose& pose = optimized.nodes[*node].T_world_node;
    if (const Sim3* S_map_place = std::get_if<Sim3>(&pose)) {
      place.T_map_place = SE3(S_map_place->rotation(), S_map_place->translation());
      place.scale = S_map_place->scale();
      continue;
    }
    const SE3* T_map_place = std::get_if<SE3>(&pose);
    require(T_map_place, "place graph: the pose graph is neither over SE(3) nor over Sim(3)");
    place.T_map_place = *T_map_place;
  }
}

}  // namespace placegraph
