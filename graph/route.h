#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/place_graph.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A place on a route. Lengths have the map's scale: metres if the map is metric.
struct RouteStep {
  PlaceId place;           ///< the place
  SE3 T_previous_place;    ///< pose relative to the previous place; identity at the first
  double leg_m = 0;        ///< distance from the previous place
  double travelled_m = 0;  ///< length of the route up to this place
};

/// A route over places, each joined to the next by a constraint.
struct Route {
  Outcome outcome;               ///< kDegenerate: the two places are not connected
  std::vector<RouteStep> steps;  ///< from the first place to the last; empty without a route
  /// Length of the whole route at the map's scale; 0 without a route.
  double length_m() const { return steps.empty() ? 0 : steps.back().travelled_m; }
};

/// The shortest route from one place to another (Dijkstra 1959).
/// Every constraint can be travelled in both directions; its length is the distance of its places
/// in the map. kDegenerate if the two places are not connected. Throws ArgumentError for unknown
/// places. For the return to earlier places by visual odometry see Siddiqui 2014, section 2.4.
Route shortest_route(const PlaceGraph& graph, PlaceId from, PlaceId to);

/// The same route in the opposite direction.
Route backtracked(const Route& route);

}  // namespace placegraph
