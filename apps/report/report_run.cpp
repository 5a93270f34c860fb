#include "apps/report/report_run.h"

#include <fmt/format.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/constraint_source.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/internal/exports/base64.h>
#include <placegraph/pipeline/run.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/report/column.h"
#include "apps/report/landmark_rows.h"
#include "apps/report/report_frames.h"
#include "apps/report/report_pictures.h"
#include "apps/results/judgement_text.h"
#include "apps/results/map_file.h"
#include "apps/results/run_judgement.h"
#include "apps/support/json_file.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

void put_position(std::vector<float>& column, const Eigen::Vector3d& p) {
  for (int i = 0; i < 3; ++i) column.push_back(static_cast<float>(p[i]));
}

json describe_keyframes(const Map& map) {
  std::vector<std::int32_t> id, frame, place;
  json thumbnails = json::array();
  for (const Keyframe& keyframe : map.keyframes) {
    id.push_back(static_cast<std::int32_t>(keyframe.id.value()));
    frame.push_back(static_cast<std::int32_t>(keyframe.frame.value()));
    place.push_back(static_cast<std::int32_t>(keyframe.place.value()));
    thumbnails.push_back(keyframe.thumbnail.empty()
                             ? ""
                             : "data:image/jpeg;base64," + to_base64(keyframe.thumbnail));
  }
  return {{"id", column(id)},
          {"frame", column(frame)},
          {"place", column(place)},
          {"thumbnails", thumbnails}};
}

json describe_landmarks(const Map& map) {
  const std::size_t step = LandmarkRows(map.landmarks.size()).step();
  std::vector<float> position, sigma;
  std::vector<std::uint8_t> colour;
  std::vector<std::int32_t> keyframe;
  bool coloured = false, certain = false;
  for (std::size_t i = 0; i < map.landmarks.size(); i += step) {
    const PointLandmark& landmark = map.landmarks[i];
    const Sim3 S_map_keyframe = map.S_map_keyframe(landmark.keyframe);
    put_position(position, S_map_keyframe * landmark.point_cam);
    coloured = coloured || landmark.rgb;
    certain = certain || landmark.covariance;
    const std::array<std::uint8_t, 3> rgb =
        landmark.rgb.value_or(std::array<std::uint8_t, 3>{128, 128, 128});
    colour.insert(colour.end(), rgb.begin(), rgb.end());
    sigma.push_back(
        landmark.covariance
            ? static_cast<float>(S_map_keyframe.scale() * std::sqrt(landmark.covariance->trace()))
            : std::numeric_limits<float>::quiet_NaN());
    keyframe.push_back(static_cast<std::int32_t>(landmark.keyframe.value()));
  }
  return {{"position", column(position, 3)},
          {"colour", coloured ? column(colour, 3) : json()},
          {"sigma_m", certain ? column(sigma) : json()},
          {"keyframe", column(keyframe)}};
}

json describe_places(const PlaceGraph& graph) {
  const std::vector<int> joined = graph.joined_components();
  std::vector<std::int32_t> id, keyframe, component;
  std::vector<float> position;
  for (std::size_t i = 0; i < graph.places.size(); ++i) {
    const Place& place = graph.places[i];
    id.push_back(static_cast<std::int32_t>(place.id.value()));
    keyframe.push_back(static_cast<std::int32_t>(place.anchor_keyframe.value()));
    component.push_back(joined[i]);
    put_position(position, place.T_map_place.translation());
  }
  return {{"id", column(id)},
          {"keyframe", column(keyframe)},
          {"component", column(component)},
          {"position", column(position, 3)}};
}

json describe_constraints(const PlaceGraph& graph) {
  std::vector<std::int32_t> from, to;
  std::vector<std::string> source;
  for (const RelativePoseConstraint& constraint : graph.constraints) {
    from.push_back(static_cast<std::int32_t>(constraint.from.value()));
    to.push_back(static_cast<std::int32_t>(constraint.to.value()));
    source.emplace_back(to_string(constraint.source));
  }
  return {{"from", column(from)}, {"to", column(to)}, {"source", text_column(source)}};
}

json describe_loops(const std::vector<LoopRecord>& loops) {
  std::vector<std::int32_t> query, match, inliers, lines;
  std::vector<float> probability, similarity;
  std::vector<std::string> stage;
  for (const LoopRecord& loop : loops) {
    query.push_back(static_cast<std::int32_t>(loop.query_frame.value()));
    match.push_back(static_cast<std::int32_t>(loop.match_frame.value()));
    inliers.push_back(loop.inliers);
    lines.push_back(loop.lines);
    probability.push_back(static_cast<float>(loop.probability));
    similarity.push_back(static_cast<float>(loop.similarity));
    stage.emplace_back(to_string(loop.stage));
  }
  return {{"query_frame", column(query)},       {"match_frame", column(match)},
          {"probability", column(probability)}, {"similarity", column(similarity)},
          {"inliers", column(inliers)},         {"lines", column(lines)},
          {"stage", text_column(stage)}};
}

/// The options whose values differ from the defaults.
json describe_options(const std::string& path, const MapOrigin& origin) {
  json differing = json::array();
  if (origin.options.empty()) return differing;
  RunOptions options;
  read_options_text(path, origin.options, options);
  const std::vector<OptionEntry> present = list_options(options),
                                 usual = list_options(RunOptions());
  for (std::size_t i = 0; i < present.size() && i < usual.size(); ++i)
    if (present[i].type != "group" && present[i].value != usual[i].value)
      differing.push_back({{"name", present[i].path},
                           {"value", present[i].value},
                           {"default_value", usual[i].value}});
  return differing;
}

/// The ground truth of the recording; nothing where it is not at its path or has none.
std::optional<Trajectory> truth_of(const StoredMap& stored) {
  if (!fs::exists(stored.origin.sequence)) return std::nullopt;
  try {
    const std::unique_ptr<Dataset> dataset = open_dataset(stored.origin.sequence);
    const std::optional<Trajectory>& truth = dataset->ground_truth();
    if (!truth || truth->size() < dataset->size()) return std::nullopt;
    for (const FrameRecord& frame : stored.map.frames)
      if (frame.frame.value() >= static_cast<std::int64_t>(truth->size())) return std::nullopt;
    return truth_of_frames(*truth, stored.map);
  } catch (const Error& error) {
    warn(fmt::format("{}: no ground truth for the report: {}", stored.origin.sequence,
                     error.what()));
    return std::nullopt;
  }
}

/// Figures of the optimized trajectory, and the alignment that fits the map: a similarity if its
/// scale is unknown.
std::optional<RunTruth> evaluate_run(const Map& map, const std::optional<Trajectory>& truth,
                                     json& figures) {
  if (!truth) return std::nullopt;
  std::optional<RunTruth> result;
  const Trajectory estimate = map.trajectory_optimized();
  for (const Alignment alignment : {Alignment::kOrigin, Alignment::kSe3, Alignment::kSim3}) {
    EvaluationOptions options;
    options.alignment = alignment;
    options.association = Association::kIndex;
    const EvaluationResult evaluated = evaluate(*truth, estimate, options);
    if (evaluated.aligned_pairs.empty()) continue;
    if (alignment == (map.metric ? Alignment::kSe3 : Alignment::kSim3))
      result = RunTruth{*truth, evaluated.alignment};
    for (const Metric& metric : metrics(evaluated))
      if (metric.value && std::isfinite(*metric.value))
        figures.push_back({{"name", metric.name},
                           {"value", *metric.value},
                           {"unit", metric.unit},
                           {"protocol", metric.protocol}});
  }
  return result;
}

/// result.json beside the map; an empty object where there is none.
json read_result(const std::string& map_path) {
  const fs::path path = fs::path(map_path).parent_path() / "result.json";
  return fs::is_regular_file(path) ? read_json(path.string()) : json::object();
}

json number_or_null(const json& result, const char* key) {
  const auto found = result.find(key);
  return found != result.end() && found->is_number() ? *found : json();
}

json describe_notes(const json& result) {
  json notes = json::array();
  if (const auto found = result.find("notes"); found != result.end() && found->is_array())
    for (const json& note : *found)
      if (note.is_string()) notes.push_back(note);
  return notes;
}

json describe_judgement_or_none(const std::optional<Judgement>& judgement) {
  if (!judgement) return {};
  json result = describe_judgement(*judgement);
  if (!judgement->expected_drift_m) result["expected_drift_m"] = nullptr;
  return result;
}

json describe_camera(const std::optional<Calibration>& calibration) {
  if (!calibration) return {};
  const Camera& camera = calibration->camera;
  return {{"width", camera.width}, {"height", camera.height}, {"fx", camera.fx},
          {"fy", camera.fy},       {"cx", camera.cx},         {"cy", camera.cy}};
}

json components_of(const Map& map) {
  json components = json::array();
  for (const MapComponent& component : map.components())
    components.push_back({{"number", component.number},
                          {"main", component.main},
                          {"first", map.frames[component.first].frame.value()},
                          {"last", map.frames[component.last].frame.value()},
                          {"posed", component.posed}});
  return components;
}

}  // namespace

std::string name_of_run(const std::string& map_path) {
  const fs::path path = fs::absolute(fs::path(map_path)).lexically_normal();
  return path.filename() == "map.db" ? path.parent_path().filename().string()
                                     : path.stem().string();
}

json describe_run_for_report(const std::string& file_or_folder) {
  return describe_run_for_report(read_stored_map(file_or_folder), map_path_of(file_or_folder));
}

json describe_run_for_report(const StoredMap& stored, const std::string& path) {
  const Map& map = stored.map;
  const json result = read_result(path);
  json figures = json::array();
  const std::optional<RunTruth> truth = evaluate_run(map, truth_of(stored), figures);
  const auto posed = std::ranges::count_if(
      map.frames, [](const FrameRecord& frame) { return frame.T_keyframe_frame.has_value(); });
  const fs::path folder = fs::absolute(fs::path(path)).lexically_normal().parent_path();
  return {{"name", name_of_run(path)},
          {"folder", folder.string()},
          {"sensor", to_string(stored.origin.sensor)},
          {"metric", map.metric},
          {"summary",
           {{"frames", map.frames.size()},
            {"posed", posed},
            {"keyframes", map.keyframes.size()},
            {"places", map.place_graph.places.size()},
            {"landmarks", map.landmarks.size()},
            {"loops_accepted", std::ranges::count_if(map.loops, &LoopRecord::accepted)},
            {"cpu_s", number_or_null(result, "cpu_s")},
            {"wall_s", number_or_null(result, "wall_s")}}},
          {"judgement", describe_judgement_or_none(stored.judgement)},
          {"notes", describe_notes(result)},
          {"options", describe_options(path, stored.origin)},
          {"figures", figures},
          {"camera", describe_camera(stored.origin.calibration)},
          {"components", components_of(map)},
          {"frames", describe_frames_for_report(map, truth)},
          {"keyframes", describe_keyframes(map)},
          {"landmarks", describe_landmarks(map)},
          {"places", describe_places(map.place_graph)},
          {"constraints", describe_constraints(map.place_graph)},
          {"loops", describe_loops(map.loops)},
          {"planes", json::array()},
          {"floor_plan", describe_floor_plan(folder.string())},
          {"street_map", json::array()},
          {"georeference", nullptr},
          {"pictures", describe_pictures(folder.string())}};
}

}  // namespace placegraph::apps
