#include <placegraph/eval/loops/route_check.h>
#include <placegraph/eval/errors/statistics.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/route.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Two frames belong to different passes if the path between them is longer than this.
constexpr double kPathBetweenPasses = 4;  // in radii of SameView

void join(PlaceGraph& graph, PlaceId from, PlaceId to, ConstraintSource source) {
  RelativePoseConstraint edge;
  edge.from = node_of_place(from);
  edge.to = node_of_place(to);
  edge.source = source;
  graph.constraints.push_back(edge);
}

/// The length of a route by the true positions of its places.
double true_length(const Route& route, const PlaceGraph& truth) {
  double length = 0;
  for (std::size_t i = 1; i < route.steps.size(); ++i)
    length += (truth.find(route.steps[i].place)->T_map_place.translation() -
               truth.find(route.steps[i - 1].place)->T_map_place.translation())
                  .norm();
  return length;
}

bool same_places(const Route& a, const Route& b) {
  return std::equal(a.steps.begin(), a.steps.end(), b.steps.begin(), b.steps.end(),
                    [](const RouteStep& s, const RouteStep& t) { return s.place == t.place; });
}

/// Pairs of `count` places, at most `limit`, spread evenly over all.
std::vector<std::pair<std::size_t, std::size_t>> pairs_of(std::size_t count, int limit) {
  std::vector<std::pair<std::size_t, std::size_t>> all, chosen;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) all.emplace_back(i, j);
  const double step = std::max(1.0, static_cast<double>(all.size()) / limit);
  for (double at = 0; at < static_cast<double>(all.size()); at += step)
    chosen.push_back(all[static_cast<std::size_t>(at)]);
  return chosen;
}

}  // namespace

void RouteCheckOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, RouteCheckOptions& o) {
  field.group("same", o.same, "criteria for frames of different passes on the same road");
  field("max_pairs", o.max_pairs, "maximum number of pairs of places", {1, 1e9});
}

PlaceGraph driven_roads(const Trajectory& truth, const RouteCheckOptions& options) {
  options.check();
  PlaceGraph roads;
  std::vector<double> driven_m;  // until each frame
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!truth.poses[i].T_world_body) continue;
    Place place;
    place.id = PlaceId(i);
    place.T_map_place = SE3(*truth.poses[i].T_world_body);
    const Place* last = roads.places.empty() ? nullptr : &roads.places.back();
    const double step =
        last ? (place.T_map_place.translation() - last->T_map_place.translation()).norm() : 0;
    driven_m.push_back((driven_m.empty() ? 0 : driven_m.back()) + step);
    if (last) join(roads, last->id, place.id, ConstraintSource::kOdometry);
    roads.places.push_back(std::move(place));
  }
  const auto& places = roads.places;
  std::vector<Eigen::Isometry3d> T_world_place;
  for (const Place& place : places) T_world_place.push_back(place.T_map_place.isometry());
  for (std::size_t i = 0; i < places.size(); ++i) {
    // The nearest frame of each pass; a pass is a stretch of neighbours within reach.
    std::optional<std::size_t> nearest;
    const auto distance = [&](std::size_t j) {
      return (places[i].T_map_place.translation() - places[j].T_map_place.translation()).norm();
    };
    for (std::size_t j = 0; j < i; ++j) {
      const bool met = driven_m[i] - driven_m[j] > kPathBetweenPasses * options.same.radius_m &&
                       options.same.holds(T_world_place[i], T_world_place[j]);
      if (met && (!nearest || distance(j) < distance(*nearest))) nearest = j;
      if (!nearest || (met && j + 1 < i)) continue;
      join(roads, places[*nearest].id, places[i].id, ConstraintSource::kLoop);
      nearest.reset();
    }
  }
  return roads;
}

RouteCheck check_routes(const PlaceGraph& graph, const std::map<PlaceId, FrameId>& frame_of_place,
                        const Trajectory& truth, const RouteCheckOptions& options) {
  const PlaceGraph roads = driven_roads(truth, options);
  PlaceGraph true_graph = graph;
  for (Place& place : true_graph.places) {
    const auto frame = frame_of_place.find(place.id);
    const bool known = frame != frame_of_place.end() && frame->second.value() >= 0 &&
                       frame->second.value() < static_cast<std::int64_t>(truth.size()) &&
                       truth.poses[static_cast<std::size_t>(frame->second.value())].T_world_body;
    require(known, "place " + to_string(place.id) + " has no true pose");
    place.T_map_place =
        SE3(*truth.poses[static_cast<std::size_t>(frame->second.value())].T_world_body);
  }
  RouteCheck result;
  std::vector<double> excesses, detours, length_errors;
  for (const auto& [i, j] : pairs_of(graph.places.size(), options.max_pairs)) {
    const PlaceId from = graph.places[i].id, to = graph.places[j].id;
    const Route computed = shortest_route(graph, from, to);
    if (!computed.outcome) {
      ++result.apart;
      continue;
    }
    ++result.pairs;
    const Route best = shortest_route(true_graph, from, to);
    const Route driven = shortest_route(roads, PlaceId(frame_of_place.at(from).value()),
                                        PlaceId(frame_of_place.at(to).value()));
    const double length = true_length(computed, true_graph);
    if (same_places(computed, best)) ++result.same_places;
    if (!(best.length_m() > 0 && driven.length_m() > 0)) continue;
    excesses.push_back(length / best.length_m() - 1);
    detours.push_back(length / driven.length_m() - 1);
    if (detours.back() <= 0.05) ++result.within_5_percent;
    result.worst_detour_m = std::max(result.worst_detour_m, length - driven.length_m());
    length_errors.push_back(std::abs(computed.length_m() / length - 1));
  }
  if (length_errors.empty()) return result;
  result.worst_excess = statistics_of(excesses).max;
  const Statistics detour = statistics_of(detours), length_error = statistics_of(length_errors);
  result.median_detour = detour.median;
  result.worst_detour = detour.max;
  result.median_length_error = length_error.median;
  result.worst_length_error = length_error.max;
  return result;
}

}  // namespace placegraph
