#include <placegraph/graph/core/error.h>
#include <placegraph/graph/route.h>

#include <algorithm>
#include <limits>
#include <queue>
#include <unordered_map>

namespace placegraph {
namespace {

/// "; there are 0, 1, 4 and 12 more"
std::string known_places(const PlaceGraph& graph) {
  constexpr std::size_t kMost = 20;
  std::string text = graph.places.empty() ? "" : "; there are ";
  for (std::size_t i = 0; i < std::min(kMost, graph.places.size()); ++i)
    text += (i == 0 ? "" : ", ") + to_string(graph.places[i].id);
  if (graph.places.size() > kMost)
    text += " and " + std::to_string(graph.places.size() - kMost) + " more";
  return text;
}

const Place& place_of(const PlaceGraph& graph, PlaceId id) {
  const Place* place = graph.find(id);
  if (!place)
    throw ArgumentError("route: there is no place " + to_string(id) + known_places(graph));
  return *place;
}

/// Lengths of the roads from every place.
using Roads = std::unordered_map<PlaceId, std::vector<std::pair<PlaceId, double>>>;

Roads roads_of(const PlaceGraph& graph) {
  Roads roads;
  for (const RelativePoseConstraint& edge : graph.constraints) {
    const PlaceId from = place_of_node(edge.from), to = place_of_node(edge.to);
    const double length = (place_of(graph, from).T_map_place.translation() -
                           place_of(graph, to).T_map_place.translation())
                              .norm();
    roads[from].emplace_back(to, length);
    roads[to].emplace_back(from, length);
  }
  return roads;
}

/// The next place on the shortest path to `to`, for every place; nothing for places without a path.
std::unordered_map<PlaceId, PlaceId> next_places(const Roads& roads, PlaceId from, PlaceId to) {
  using Open = std::pair<double, PlaceId>;  // equal lengths: the lower id first
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  std::unordered_map<PlaceId, double> length;
  std::unordered_map<PlaceId, PlaceId> next;
  open.emplace(0, to);
  length[to] = 0;
  while (!open.empty()) {
    const auto [done, place] = open.top();
    open.pop();
    if (place == from) break;
    if (done > length.at(place)) continue;
    const auto leaving = roads.find(place);
    if (leaving == roads.end()) continue;
    for (const auto& [neighbour, road] : leaving->second) {
      const auto known = length.find(neighbour);
      if (known != length.end() && known->second <= done + road) continue;
      length[neighbour] = done + road;
      next[neighbour] = place;
      open.emplace(done + road, neighbour);
    }
  }
  return next;
}

}  // namespace

Route shortest_route(const PlaceGraph& graph, PlaceId from, PlaceId to) {
  Route route;
  const Place* place = &place_of(graph, from);
  place_of(graph, to);
  const auto next = next_places(roads_of(graph), from, to);
  if (from != to && !next.count(from)) {
    route.outcome =
        Outcome::failure(Outcome::Code::kDegenerate,
                         "nothing joins place " + to_string(from) + " to place " + to_string(to));
    return route;
  }
  route.outcome = Outcome::ok();
  route.steps.push_back({from, SE3(), 0, 0});
  while (place->id != to) {
    const Place& then = place_of(graph, next.at(place->id));
    RouteStep step;
    step.place = then.id;
    step.T_previous_place = place->T_map_place.inverse() * then.T_map_place;
    step.leg_m = step.T_previous_place.translation().norm();
    step.travelled_m = route.length_m() + step.leg_m;
    route.steps.push_back(step);
    place = &then;
  }
  return route;
}

Route backtracked(const Route& route) {
  Route back;
  back.outcome = route.outcome;
  for (std::size_t i = route.steps.size(); i-- > 0;) {
    RouteStep step{route.steps[i].place, SE3(), 0, 0};
    if (!back.steps.empty()) {
      const RouteStep& leg = route.steps[i + 1];
      step.T_previous_place = leg.T_previous_place.inverse();
      step.leg_m = leg.leg_m;
      step.travelled_m = back.length_m() + leg.leg_m;
    }
    back.steps.push_back(step);
  }
  return back;
}

}  // namespace placegraph
