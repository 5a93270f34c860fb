#include <placegraph/eval/loops/loop_check.h>
#include <placegraph/eval/loops/place_check.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/eval/alignment/umeyama.h>
#include <placegraph/pipeline/results/run_judgement.h>

#include <nlohmann/json.hpp>

namespace placegraph {
namespace {

using nlohmann::json;

json judge_trajectory(const Trajectory& truth, const Trajectory& estimate, Alignment alignment) {
  EvaluationOptions options;
  options.association = Association::kIndex;
  options.alignment = alignment;
  const EvaluationResult result = evaluate(truth, estimate, options);
  if (!result.outcome) return {{"refused", result.outcome.reason}};
  json figures;
  for (const Metric& metric : metrics(result))
    figures[metric.key] = metric.value ? json(*metric.value) : json(nullptr);
  return figures;
}

/// Tolerance of the loop check: depth cameras measure to centimetres, other sensors to a metre.
json judge_loops(const Trajectory& truth, const RunResult& run) {
  LoopCheckOptions options;
  if (run.sensor != Sensor::kRgbd) options.max_translation_m = 1;
  const LoopCheck check = check_loops(truth, run.map.loops, options);
  json loops = json::array();
  for (const CheckedLoop& loop : check.loops)
    loops.push_back({{"query", loop.query_frame},
                     {"match", loop.match_frame},
                     {"translation_error_m", loop.translation_error_m},
                     {"rotation_error_deg", loop.rotation_error_deg}});
  return {{"max_translation_m", options.max_translation_m},
          {"max_rotation_deg", options.max_rotation_deg},
          {"min_frames_apart", options.min_frames_apart},
          {"true_loops", check.correct},
          {"false_loops", check.wrong},
          {"too_near", check.too_near},
          {"loops", loops}};
}

json judge_places(const Trajectory& truth, const RunResult& run) {
  const PlaceCheckOptions options;
  const PlaceCheck check = check_places(run.map, truth, options);
  return {{"max_distance_m", options.max_distance_m},
          {"max_angle_deg", options.max_angle_deg},
          {"revisit_radius_m", options.revisit.same.radius_m},
          {"revisit_heading_deg", options.revisit.same.heading_deg},
          {"revisit_min_age", options.revisit.min_age},
          {"purity", check.purity()},
          {"revisited_places", check.revisited_places},
          {"added_places", check.added_places},
          {"growth", check.growth()},
          {"adjacent", check.adjacent},
          {"true_adjacent", check.true_adjacent},
          {"adjacency_precision", check.adjacency_precision()},
          {"adjacency_recall", check.adjacency_recall()}};
}

/// True and estimated poses of the frames that have both.
std::vector<std::pair<SE3, SE3>> known_pairs(const Trajectory& truth, const Map& map,
                                             const Trajectory& estimate) {
  std::vector<std::pair<SE3, SE3>> pairs;
  for (std::size_t i = 0; i < estimate.size() && i < map.frames.size(); ++i) {
    const auto frame = static_cast<std::size_t>(map.frames[i].frame.value());
    if (estimate.poses[i].T_world_body && frame < truth.size() && truth.poses[frame].T_world_body)
      pairs.emplace_back(*truth.poses[frame].T_world_body, *estimate.poses[i].T_world_body);
  }
  return pairs;
}

}  // namespace

Trajectory truth_of_frames(const Trajectory& truth, const Map& map) {
  Trajectory result;
  for (const FrameRecord& frame : map.frames)
    result.poses.push_back(truth.poses.at(static_cast<std::size_t>(frame.frame.value())));
  return result;
}

SE3 fit_by_first_pose(const Trajectory& truth, const Map& map, const Trajectory& estimate) {
  const auto pairs = known_pairs(truth, map, estimate);
  if (pairs.empty()) return {};
  return pairs.front().first * pairs.front().second.inverse();
}

SE3 fit_by_positions(const Trajectory& truth, const Map& map, const Trajectory& estimate) {
  std::vector<Eigen::Vector3d> from, to;
  for (const auto& [T_truth_cam, T_map_cam] : known_pairs(truth, map, estimate)) {
    from.push_back(T_map_cam.translation());
    to.push_back(T_truth_cam.translation());
  }
  const AlignmentResult fit = umeyama(from, to, false);
  if (!fit.outcome) return {};
  return {fit.R_truth_estimate, fit.t_truth_estimate};
}

json judge_run(const Trajectory& truth, const RunResult& run, const Trajectory& optimized) {
  const Trajectory seen = truth_of_frames(truth, run.map);
  json summary = {{"path_m", seen.path_length()},
                  {"evaluation",
                   {{"origin", judge_trajectory(seen, optimized, Alignment::kOrigin)},
                    {"se3", judge_trajectory(seen, optimized, Alignment::kSe3)},
                    {"sim3", judge_trajectory(seen, optimized, Alignment::kSim3)}}},
                  {"place_check", judge_places(truth, run)}};
  if (run.map.metric) summary["loop_check"] = judge_loops(truth, run);
  return summary;
}

}  // namespace placegraph
