#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/place_graph.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A place on a route. Lengths are in the map's unit: the metre if the map is metric.
struct RouteStep {
  PlaceId place;           ///< the place
  SE3 T_previous_place;    ///< relative to the place before; identity at the first
  double leg_m = 0;        ///< distance from the place before
  double travelled_m = 0;  ///< length of the route up to this place
};

/// A route over places, each joined to the next by a constraint.
struct Route {
  Outcome outcome;               ///< kDegenerate: nothing joins the two places
  std::vector<RouteStep> steps;  ///< from the first place to the last; empty without a route
  /// Length of the whole route in the map's unit; 0 without a route.
  double length_m() const { return steps.empty() ? 0 : steps.back().travelled_m; }
};

/// The shortest route from one place to another (Dijkstra 1959).
/// Every constraint can be travelled both ways and is as long as its places lie apart in the map.
/// kDegenerate if nothing joins the two. Throws ArgumentError for places that are not there. That a
/// memory of motion leads back: Siddiqui 2014, section 2.4.
Route shortest_route(const PlaceGraph& graph, PlaceId from, PlaceId to);

/// The same route in the opposite direction.
Route backtracked(const Route& route);

}  // namespace placegraph
