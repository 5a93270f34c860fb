#include "apps/map/cmd_route.h"

#include <fmt/format.h>
#include <placegraph/eval/plots/plot.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/route.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "apps/results/run_map.h"
#include "apps/support/json_file.h"
#include "apps/support/output.h"
#include "apps/support/plot_file.h"

namespace placegraph::apps {
namespace {

using nlohmann::json;

struct RouteArguments {
  std::string map, out, plot;
  std::int64_t from = 0, to = 0;
  bool backtrack = false, force = false;
};

/// Between where a place's view looks (its z axis) and where the way goes on from there [deg].
double off_travel_deg(const RouteStep& next) {
  const Eigen::Vector3d way = next.T_previous_place.translation();
  return rad_to_deg(std::atan2(way.head<2>().norm(), way.z()));
}

json step_json(const Route& route, std::size_t i, const RunMap& map) {
  const RouteStep& step = route.steps[i];
  const Place& place = *map.graph.find(step.place);
  json entry = {
      {"place", step.place},
      {"T_previous_place", pose_json(step.T_previous_place)},
      {"leg_m", step.leg_m},
      {"travelled_m", step.travelled_m},
      {"T_map_place", pose_json(place.T_map_place)},
      {"labels", place.labels},
      {"view", {{"keyframe", place.anchor_keyframe}, {"frame", map.anchor_frame(place)}}}};
  if (i + 1 < route.steps.size() && route.steps[i + 1].leg_m > 0)
    entry["view_off_travel_deg"] = off_travel_deg(route.steps[i + 1]);
  return entry;
}

std::string route_json(const Route& route, const RunMap& map) {
  json steps = json::array();
  for (std::size_t i = 0; i < route.steps.size(); ++i) steps.push_back(step_json(route, i, map));
  return json{{"from", route.steps.front().place},
              {"to", route.steps.back().place},
              {"length_m", route.length_m()},
              {"steps", steps}}
             .dump(1) +
         "\n";
}

std::string route_text(const Route& route, const RunMap& map) {
  std::string text = fmt::format("{} places, {:.2f} m\n place  frame    leg [m]  travelled [m]\n",
                                 route.steps.size(), route.length_m());
  for (const RouteStep& step : route.steps)
    text +=
        fmt::format("{:>6} {:>6} {:>10.3f} {:>14.3f}\n", step.place,
                    map.anchor_frame(*map.graph.find(step.place)), step.leg_m, step.travelled_m);
  return text;
}

Plot route_plot(const Route& route, const RunMap& map) {
  Plot plot;
  plot.title = fmt::format("from place {} to place {}: {:.1f} m", route.steps.front().place,
                           route.steps.back().place, route.length_m());
  PlotCurve places{"places", {}, true}, way{"way", {}, false};
  for (const Place& place : map.graph.places)
    places.positions_m.emplace_back(place.T_map_place.translation());
  for (const RouteStep& step : route.steps)
    way.positions_m.emplace_back(map.graph.find(step.place)->T_map_place.translation());
  plot.curves = {places, way};
  for (const RelativePoseConstraint& edge : map.graph.constraints)
    if (edge.source == ConstraintSource::kLoop)
      plot.links_m.emplace_back(map.graph.find(edge.from)->T_map_place.translation(),
                                map.graph.find(edge.to)->T_map_place.translation());
  return plot;
}

void run(const RouteArguments& arguments) {
  for (const std::string& path : {arguments.out, arguments.plot})
    if (!path.empty()) require_free(path, arguments.force);
  require_plot_name(arguments.plot);
  const RunMap map = read_run_map(arguments.map);
  Route route = shortest_route(map.graph, arguments.from, arguments.to);
  if (!route.outcome) throw NoAnswer(route.outcome.reason);
  if (arguments.backtrack) route = backtracked(route);
  if (!arguments.out.empty()) write_file(arguments.out, route_json(route, map));
  if (!arguments.plot.empty()) write_plot(arguments.plot, route_plot(route, map));
  std::fputs(route_text(route, map).c_str(), stdout);
}

}  // namespace

void add_route_command(CLI::App& app) {
  auto arguments = std::make_shared<RouteArguments>();
  RouteArguments& a = *arguments;
  CLI::App* command =
      app.add_subcommand("route", "The shortest way over the places of a map, or the way back");
  command->footer(
      "placegraph route out/town --from 0 --to 40 --backtrack --out way.json --plot way.png");
  command->add_option("MAP", a.map, "folder that placegraph run has written, or a map.db")
      ->required()
      ->check(CLI::ExistingPath);
  command->add_option("--from", a.from, "place the way begins at")->required();
  command->add_option("--to", a.to, "place it leads to")->required();
  command->add_flag("--backtrack", a.backtrack,
                    "then print the way back: the same places from the last to the first");
  command->add_option("--out", a.out,
                      "write the way as JSON: relative poses from place to place, the frame whose "
                      "view to expect at each");
  command->add_option("--plot", a.plot, "draw the places and the way (.png or .svg)");
  command->add_flag("--force", a.force, "overwrite files");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace placegraph::apps
