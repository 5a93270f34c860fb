#include <fmt/format.h>
#include <placegraph/eval/plots/plot.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/place_transitions.h>
#include <placegraph/graph/pose_graph/constraint_source.h>
#include <placegraph/graph/text/csv_text.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/files/json_file.h>
#include <placegraph/pipeline/results/component_files.h>
#include <placegraph/pipeline/results/run_files.h>
#include <placegraph/pipeline/results/run_judgement.h>
#include <placegraph/pipeline/results/run_map.h>
#include <placegraph/pipeline/results/run_results.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

namespace placegraph {
namespace {

using nlohmann::json;

std::vector<FrameId> lost_frames(const Map& map, const Trajectory& trajectory) {
  std::vector<FrameId> lost;
  for (std::size_t i = 0; i < trajectory.size(); ++i)
    if (!trajectory.poses[i].T_world_body) lost.push_back(map.frames[i].frame);
  return lost;
}

PlotCurve curve_of(const Trajectory& trajectory, const std::string& name) {
  PlotCurve curve{name, {}, false};
  for (const StampedPose& pose : trajectory.poses) {
    curve.positions_m.emplace_back();
    if (pose.T_world_body) curve.positions_m.back() = pose.T_world_body->translation();
  }
  return curve;
}

/// The trajectories compared with the truth: online, optimized, and those of other components.
/// Those that cannot be compared are left out.
std::vector<EvaluationResult> evaluated(const Map& map, const Trajectory& optimized,
                                        const Trajectory& ground_truth) {
  EvaluationOptions options;
  options.association = Association::kIndex;
  options.alignment = map.metric ? Alignment::kOrigin : Alignment::kSim3;
  const Trajectory truth = truth_of_frames(ground_truth, map);
  std::vector<EvaluationResult> results;
  const auto add = [&](const Trajectory& trajectory, const std::string& name) {
    EvaluationResult result = evaluate(truth, trajectory, options, name);
    if (result.outcome) results.push_back(std::move(result));
  };
  add(map.trajectory_online, "online");
  add(optimized, "optimized");
  if (results.empty()) return results;
  for (const MapComponent& component : map.components())
    if (!component.main)
      add(map.trajectory_optimized(component.number),
          "component " + std::to_string(component.number));
  return results;
}

/// The alignment of the optimized trajectory, else of the other one.
AlignmentResult main_alignment(const std::vector<EvaluationResult>& results) {
  const auto optimized = std::ranges::find(results, "optimized", &EvaluationResult::name);
  return optimized != results.end() ? optimized->alignment : results.front().alignment;
}

/// Adds the accepted loops between the optimized poses of their frames.
void add_loops(const Map& map, const Trajectory& optimized, const AlignmentResult& alignment,
               Plot& plot) {
  const auto position_of = [&](FrameId frame) -> std::optional<Eigen::Vector3d> {
    const auto record = std::ranges::find(map.frames, frame, &FrameRecord::frame);
    if (record == map.frames.end()) return std::nullopt;
    const auto& pose =
        optimized.poses[static_cast<std::size_t>(record - map.frames.begin())].T_world_body;
    if (!pose) return std::nullopt;
    return alignment.apply(*pose).translation();
  };
  for (const LoopRecord& loop : map.loops) {
    if (!loop.accepted()) continue;
    const auto query = position_of(loop.query_frame), match = position_of(loop.match_frame);
    if (query && match) plot.links_m.emplace_back(*query, *match);
  }
}

/// Adds the places that are in the frame of the map, with their numbers.
void add_places(const Map& map, const AlignmentResult& alignment, Plot& plot) {
  const std::vector<int> components = map.place_graph.joined_components();
  const int main = map.main_component();
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (components[i] != main) continue;
    const Place& place = map.place_graph.places[i];
    plot.places_m.push_back(alignment.apply(place.T_map_place.isometry()).translation());
    plot.place_names.push_back(to_string(place.id));
  }
}

Sim3 similarity_of(const SE2&) { throw ArgumentError("a place graph is not planar"); }
Sim3 similarity_of(const SE3& T) { return Sim3(T); }
Sim3 similarity_of(const Sim3& S) { return S; }

}  // namespace

json describe_motion(const PlaceGraph& graph) {
  std::vector<double> deviations;
  for (const RelativePoseConstraint& constraint : graph.constraints) {
    if (constraint.source != ConstraintSource::kOther) continue;
    const Sim3 S_from_to =
        std::visit([](const auto& T) { return similarity_of(T); }, constraint.T_from_to);
    const Sim3 S_seen = graph.find(place_of_node(constraint.from))->S_map_place().inverse() *
                        graph.find(place_of_node(constraint.to))->S_map_place();
    const Eigen::VectorXd error =
        (S_from_to.inverse() * S_seen).log().head(constraint.information.rows());
    deviations.push_back(
        std::sqrt(error.dot(constraint.information * error) / static_cast<double>(error.size())));
  }
  json motion = {{"constraints", deviations.size()}, {"median_deviation", nullptr}};
  if (deviations.empty()) return motion;
  const auto middle = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 2);
  std::nth_element(deviations.begin(), middle, deviations.end());
  motion["median_deviation"] = *middle;
  return motion;
}

/// Confidence of each frame, rounded, and the reasons of those without a pose.
json describe_frames(const std::vector<FrameRecord>& frames) {
  json confidence = json::array(), reasons = json::array();
  for (const FrameRecord& frame : frames) {
    confidence.push_back(frame.confidence ? json(std::round(100 * *frame.confidence) / 100)
                                          : json());
    if (!frame.reason.empty())
      reasons.push_back({{"frame", frame.frame.value()}, {"reason", frame.reason}});
  }
  return {{"first_frame", frames.empty() ? json() : json(frames.front().frame.value())},
          {"confidence", confidence},
          {"reasons", reasons}};
}

json describe_run(const RunResult& run, const Trajectory& optimized) {
  const Map& map = run.map;
  std::set<int> components;
  for (const Place& place : map.place_graph.places) components.insert(place.component);
  const auto accepted = std::count_if(map.loops.begin(), map.loops.end(),
                                      [](const LoopRecord& loop) { return loop.accepted(); });
  return {{"sensor", to_string(run.sensor)},
          {"frames", map.frames.size()},
          {"posed", optimized.posed()},
          {"posed_online", map.trajectory_online.posed()},
          {"lost_frames", lost_frames(map, optimized)},
          {"lost_frames_online", lost_frames(map, map.trajectory_online)},
          {"frame_health", describe_frames(map.frames)},
          {"keyframes", map.keyframes.size()},
          {"places", map.place_graph.places.size()},
          {"components", components.size()},
          {"component_trajectories", describe_components(map)},
          {"loops_checked", map.loops.size()},
          {"loops_accepted", accepted},
          {"metric", map.metric},
          {"lens_k1", run.lens_k1}};
}

Plot run_plot(const Map& map, const Trajectory& optimized, const Trajectory* ground_truth,
              const std::string& title) {
  Plot plot;
  AlignmentResult alignment;
  if (ground_truth) {
    const std::vector<EvaluationResult> results = evaluated(map, optimized, *ground_truth);
    if (!results.empty()) {
      plot = plot_of(results);
      alignment = main_alignment(results);
    }
  }
  if (plot.curves.empty()) {
    plot.curves = {curve_of(map.trajectory_online, "online"), curve_of(optimized, "optimized")};
    plot.unit = unit_of(map.metric);
    plot.notes = {"no ground truth: positions in the frame of the map, not aligned"};
  }
  add_places(map, alignment, plot);
  add_loops(map, optimized, alignment, plot);
  plot.title = title;
  return plot;
}

std::string run_picture(const Map& map, const Trajectory& optimized, const Trajectory* truth,
                        const std::string& title) {
  return to_svg(run_plot(map, optimized, truth, title));
}

}  // namespace placegraph
