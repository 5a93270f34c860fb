#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/place_graph.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A place on a way.
struct RouteStep {
  PlaceId place;
  SE3 T_previous_place;    ///< seen from the place before, in the map's unit; identity at the first
  double leg_m = 0;        ///< from the place before, in the map's unit, as all lengths here
  double travelled_m = 0;  ///< from the first place on
};

/// A way over places.
struct Route {
  Outcome outcome;
  std::vector<RouteStep> steps;  ///< from the first place to the last
  double length_m() const { return steps.empty() ? 0 : steps.back().travelled_m; }
};

/// The shortest way from place to place (Dijkstra 1959): every constraint is a road both ways, as
/// long as its places lie apart in the map. What makes motion memory one is that it leads back
/// (Siddiqui 2014, 2.4). Outcomes: degenerate (nothing joins the two). Throws ArgumentError for
/// places that are not there.
Route shortest_route(const PlaceGraph& graph, PlaceId from, PlaceId to);

/// The same places the other way round.
Route backtracked(const Route& route);

}  // namespace placegraph
