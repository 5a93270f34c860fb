#include <placegraph/pipeline/report/run_part.h>

#include <fmt/format.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/files/json_file.h>
#include <placegraph/pipeline/map/map_file.h>
#include <placegraph/pipeline/report/served_page.h>
#include <placegraph/pipeline/run.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>

#include <placegraph/pipeline/report/frames_part.h>
#include <placegraph/pipeline/report/georeference_part.h>
#include <placegraph/pipeline/report/map_part.h>
#include <placegraph/pipeline/report/parts.h>
#include <placegraph/pipeline/report/planes_part.h>
#include <placegraph/pipeline/report/street_map_part.h>
#include <placegraph/pipeline/results/result_json.h>
#include <placegraph/pipeline/results/run_judgement.h>

namespace placegraph::report {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

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
std::optional<Trajectory> truth_of(const StoredMap& stored, const LogSink& log) {
  if (!fs::exists(stored.origin.sequence)) return std::nullopt;
  try {
    const std::unique_ptr<Dataset> dataset = open_dataset(stored.origin.sequence);
    const std::optional<Trajectory>& truth = dataset->ground_truth();
    if (!truth || truth->size() < dataset->size()) return std::nullopt;
    for (const FrameRecord& frame : stored.map.frames)
      if (frame.frame.value() >= static_cast<std::int64_t>(truth->size())) return std::nullopt;
    return truth_of_frames(*truth, stored.map);
  } catch (const Error& error) {
    if (log)
      log(LogLevel::kWarning, fmt::format("{}: no ground truth for the report: {}",
                                          stored.origin.sequence, error.what()));
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
    for (const json& figure : describe_figures(metrics(evaluated))) figures.push_back(figure);
  }
  return result;
}

/// result.json beside the map; an empty object where there is none.
json read_result(const std::string& map_path) {
  const fs::path path = fs::path(map_path).parent_path() / "result.json";
  json result = json::object();
  if (!fs::is_regular_file(path)) return result;
  take_json(path.string(), "run", [&](const json& read) {
    (void)metric_of(read);  // throws for another form
    result = read;
  });
  return result;
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

json summary_of(const Map& map, const json& result) {
  const auto posed = std::ranges::count_if(
      map.frames, [](const FrameRecord& frame) { return frame.T_keyframe_frame.has_value(); });
  return {{"frames", map.frames.size()},
          {"posed", posed},
          {"keyframes", map.keyframes.size()},
          {"places", map.place_graph.places.size()},
          {"landmarks", map.landmarks.size()},
          {"loops_accepted", std::ranges::count_if(map.loops, &LoopRecord::accepted)},
          {"cpu_s", number_or_null(result, "cpu_s")},
          {"wall_s", number_or_null(result, "wall_s")}};
}

/// Name of the recording: runs of one recording can be compared frame by frame.
std::string recording_of(const MapOrigin& origin) {
  return (fs::path(origin.sequence) / "").lexically_normal().parent_path().filename().string();
}

std::string content_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw FileError(path.string(), "cannot be opened for reading");
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// The SVG files in the folder of a run, by name; those of more than 4 MB are left out.
json describe_pictures(const std::string& folder) {
  constexpr std::uintmax_t kMostBytes = 4'000'000;
  std::vector<fs::path> paths;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() == ".svg" &&
        entry.file_size() <= kMostBytes)
      paths.push_back(entry.path());
  std::ranges::sort(paths);
  json pictures = json::array();
  for (const fs::path& path : paths)
    pictures.push_back(describe_picture(path.stem().string(), path.string(), content_of(path)));
  return pictures;
}

/// Puts a part of the page that the map does not need; without it, and with a warning, where its
/// file is broken.
void put_part(const LogSink& log, const std::function<void()>& put) {
  try {
    put();
  } catch (const FileError& error) {
    if (log) log(LogLevel::kWarning, fmt::format("left out of the page: {}", error.what()));
  }
}

/// What other files in the folder of the run hold.
void put_results_beside(const std::string& folder, const Map& map, const LogSink& log, json& run) {
  put_part(log, [&] {
    if (const std::optional<FloorPlan> plan = floor_plan_in(folder)) {
      run["floor_plan"] = describe_floor_plan(*plan);
      run["planes"] = describe_planes(*plan);
      run["up"] = up_of_plan(plan->R_plan_map);
    }
  });
  put_part(log, [&] {
    if (const std::optional<StreetMap> street = street_map_in(folder)) {
      run["street_map"] = describe_street_map(*street);
      run["up"] = up_of_plan(street->R_plan_map);
    }
  });
  put_part(log, [&] {
    if (const std::string earth = georeference_of(folder); !earth.empty())
      run["georeference"] = describe_georeference(earth, map);
  });
  run["pictures"] = describe_pictures(folder);
}

}  // namespace

json report_data(const std::string& title, const std::string& program, json runs) {
  json data = bare_report(program, title);
  data["runs"] = std::move(runs);
  return data;
}

json describe_run_for_report(const std::string& file_or_folder, const std::string& georeference,
                             const LogSink& log) {
  return describe_run_for_report(read_stored_map(file_or_folder, log), map_path_of(file_or_folder),
                                 georeference, log);
}

json describe_run_for_report(const StoredMap& stored, const std::string& path,
                             const std::string& georeference, const LogSink& log) {
  const Map& map = stored.map;
  json figures = json::array();
  const std::optional<RunTruth> truth = evaluate_run(map, truth_of(stored, log), figures);
  const fs::path folder = fs::absolute(fs::path(path)).lexically_normal().parent_path();
  // What lies beside another file, as an edited map, is that of the run.
  const bool own = fs::path(path).filename() == "map.db";
  const json result = own ? read_result(path) : json::object();
  json run = bare_run(name_of_run(path), describe_frames_for_report(map, truth));
  run["folder"] = folder.string();
  run["recording"] = recording_of(stored.origin);
  run["sensor"] = to_string(stored.origin.sensor);
  run["metric"] = map.metric;
  run["summary"] = summary_of(map, result);
  run["judgement"] = describe_judgement_or_none(stored.judgement);
  run["notes"] = describe_notes(result);
  run["options"] = describe_options(path, stored.origin);
  run["figures"] = figures;
  run["camera"] = describe_camera(stored.origin.calibration);
  const auto& calibration = stored.origin.calibration;
  run["components"] = describe_components_for_report(map);
  run["keyframes"] = describe_keyframes(map, calibration ? &*calibration : nullptr);
  run["landmarks"] = describe_landmarks(map);
  run["places"] = describe_places(map.place_graph);
  run["constraints"] = describe_constraints(map.place_graph);
  run["loops"] = describe_loops(map.loops);
  if (own) put_results_beside(folder.string(), map, log, run);
  if (!georeference.empty()) run["georeference"] = describe_georeference(georeference, map);
  return run;
}

}  // namespace placegraph::report
