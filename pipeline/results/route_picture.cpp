#include <fmt/format.h>
#include <placegraph/eval/plots/plot.h>
#include <placegraph/graph/text/id_format.h>
#include <placegraph/pipeline/results/run_map.h>

#include <algorithm>

namespace placegraph {
namespace {

/// The places in the order in which their numbers get room in a plot: both ends of the path, its
/// other places, the rest of the map.
std::vector<Place> places_by_rank(const Route& route, const PlaceGraph& graph) {
  const auto rank = [&](const Place& place) {
    if (place.id == route.steps.front().place || place.id == route.steps.back().place) return 0;
    return std::ranges::any_of(route.steps,
                               [&](const RouteStep& step) { return step.place == place.id; })
               ? 1
               : 2;
  };
  std::vector<Place> places = graph.places;
  std::ranges::stable_sort(places, {}, rank);
  return places;
}

}  // namespace

std::string route_picture(const Route& route, const RunMap& map) {
  Plot plot;
  plot.title = fmt::format("from place {} to place {}: {:.1f} {}", route.steps.front().place,
                           route.steps.back().place, route.length_m(), map.unit());
  plot.unit = map.unit();
  plot.notes = {"positions and numbers of the places, in the frame of the map"};
  PlotCurve all{"map", {}, true}, path{"path", {}, false, 4};
  for (const Place& place : map.graph.places)
    all.positions_m.emplace_back(place.T_map_place.translation());
  for (const Place& place : places_by_rank(route, map.graph)) {
    plot.places_m.push_back(place.T_map_place.translation());
    plot.place_names.push_back(to_string(place.id));
  }
  for (const RouteStep& step : route.steps)
    path.positions_m.emplace_back(map.graph.find(step.place)->T_map_place.translation());
  plot.curves = {all, path};
  for (const RelativePoseConstraint& edge : map.graph.constraints)
    if (edge.source == ConstraintSource::kLoop)
      plot.links_m.emplace_back(map.graph.find(place_of_node(edge.from))->T_map_place.translation(),
                                map.graph.find(place_of_node(edge.to))->T_map_place.translation());
  return to_svg(plot);
}

}  // namespace placegraph
