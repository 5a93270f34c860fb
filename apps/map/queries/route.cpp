#include "apps/map/queries/route.h"

#include <fmt/format.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/support/numbers_json.h"
#include "apps/support/output.h"
#include "apps/support/plot_file.h"

namespace placegraph::apps {
namespace {

using nlohmann::json;

/// Angle between the optical axis (z) of a place's view and the path to the next place [deg].
double off_travel_deg(const RouteStep& next) {
  const Eigen::Vector3d leg = next.T_previous_place.translation();
  return rad_to_deg(std::atan2(leg.head<2>().norm(), leg.z()));
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

}  // namespace

RouteResult route(const RouteArguments& arguments) {
  for (const std::string& path : {arguments.out, arguments.plot})
    if (!path.empty()) require_free(path, arguments.force);
  require_plot_name(arguments.plot);
  RouteResult result{{}, read_run_map(arguments.map)};
  result.route = shortest_route(result.map.graph, arguments.from, arguments.to);
  if (!result.route.outcome) throw NoResult(result.route.outcome.reason);
  if (arguments.backtrack) result.route = backtracked(result.route);
  if (!arguments.out.empty()) write_file(arguments.out, to_json(result));
  if (!arguments.plot.empty()) write_plot(arguments.plot, route_picture(result.route, result.map));
  return result;
}

std::string to_json(const RouteResult& result) {
  const Route& route = result.route;
  json steps = json::array();
  for (std::size_t i = 0; i < route.steps.size(); ++i)
    steps.push_back(step_json(route, i, result.map));
  return json_text(json{{"from", route.steps.front().place},
                        {"to", route.steps.back().place},
                        {"unit", result.map.metric ? "m" : "arbitrary"},
                        {"length_m", route.length_m()},
                        {"steps", steps}},
                   1);
}

std::string to_text(const RouteResult& result) {
  const Route& route = result.route;
  const std::string unit = result.map.unit();
  const std::string leg = fmt::format("{:>10}", "leg [" + unit + "]"),
                    travelled = fmt::format("{:>14}", "travelled [" + unit + "]");
  std::string text = fmt::format("{} places, {:.2f} {}{}\n place  frame {} {}\n",
                                 route.steps.size(), route.length_m(), unit,
                                 result.map.metric ? "" : " (scale unknown)", leg, travelled);
  for (const RouteStep& step : route.steps)
    text += fmt::format("{:>6} {:>6} {:>{}.3f} {:>{}.3f}\n", step.place.value(),
                        result.map.anchor_frame(*result.map.graph.find(step.place)).value(),
                        step.leg_m, leg.size(), step.travelled_m, travelled.size());
  return text;
}

}  // namespace placegraph::apps
