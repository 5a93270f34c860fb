#include "apps/saved_map/cmd_map.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/map_revisits.h>
#include <placegraph/graph/place_transitions.h>
#include <placegraph/graph/pose_graph/rigid_graph.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/place_graph_export.h>
#include <placegraph/io/measurements/loop_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <placegraph/pipeline/places/place_mapper.h>
#include <placegraph/pipeline/run.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/saved_map/cmd_map_label.h"
#include "apps/saved_map/cmd_map_learn.h"
#include "apps/saved_map/cmd_map_plan.h"
#include "apps/saved_map/cmd_map_semantic.h"
#include "apps/results/map_file.h"
#include "apps/results/run_files.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

using nlohmann::json;

struct InfoArguments {
  std::string map;
  bool as_json = false;
};

/// A form that a map, or a part of it, is written in: another one is another line here.
struct ExportForm {
  std::string flag, help;
  bool needs_poses = false;  ///< refused for a map without a camera
  std::function<void(const std::string& path, const StoredMap& stored)> write;
};

std::vector<ExportForm> export_forms() {
  return {{"--g2o", "the place graph", true,
           [](const std::string& path, const StoredMap& stored) {
             write_g2o(path, stored.map.place_graph.pose_graph());
           }},
          {"--g2o-se3", "the same without the scales of places, for programs that know none", true,
           [](const std::string& path, const StoredMap& stored) {
             write_g2o(path, rigid_graph(stored.map.place_graph.pose_graph()));
           }},
          {"--places", "places, members, edges and loops as JSON", false,
           [](const std::string& path, const StoredMap& stored) {
             write_file(path, places_json(stored.map));
           }},
          {"--tum", "the optimized trajectory, TUM's form", true,
           [](const std::string& path, const StoredMap& stored) {
             write_trajectory(path, stored.map.trajectory_optimized(), TrajectoryFormat::kTum);
           }},
          {"--kitti", "the optimized trajectory, KITTI's form", true,
           [](const std::string& path, const StoredMap& stored) {
             write_trajectory(path, stored.map.trajectory_optimized(), TrajectoryFormat::kKitti);
           }},
          {"--graphml", "the topological map: places, transitions, loops; GraphML", true,
           [](const std::string& path, const StoredMap& stored) {
             write_file(path, to_graphml(stored.map.place_graph, place_transitions(stored.map)));
           }},
          {"--dot", "the same for Graphviz", true,
           [](const std::string& path, const StoredMap& stored) {
             write_file(path, to_dot(stored.map.place_graph, place_transitions(stored.map)));
           }},
          {"--revisits", "which older frame every frame is nearest to, for placegraph loops", true,
           [](const std::string& path, const StoredMap& stored) {
             write_loop_predictions(path, map_revisits(stored.map));
           }}};
}

struct ExportArguments {
  std::string map;
  std::vector<std::string> paths;  ///< one per form
  bool force = false;
};

double path_length(const Trajectory& trajectory) {
  double length = 0;
  const StampedPose* before = nullptr;
  for (const StampedPose& pose : trajectory.poses) {
    if (pose.T_world_body && before)
      length += (pose.T_world_body->translation() - before->T_world_body->translation()).norm();
    if (pose.T_world_body) before = &pose;
  }
  return length;
}

json describe_map(const std::string& path, const StoredMap& stored) {
  const Map& map = stored.map;
  const MapSizes sizes = map_sizes(path);
  const Trajectory optimized = map.trajectory_optimized();
  std::set<int> components;
  for (const Place& place : map.place_graph.places) components.insert(place.component);
  std::int64_t features = 0, views = 0;
  for (const Keyframe& keyframe : map.keyframes) {
    features += static_cast<std::int64_t>(keyframe.features.size());
    views += !keyframe.view.empty();
  }
  json info = {{"file", path},
               {"schema", sizes.schema},
               {"finished", stored.finished},
               {"sequence", stored.origin.sequence},
               {"sensor", stored.origin.calibration ? to_string(stored.origin.sensor) : "images"},
               {"places", map.place_graph.places.size()},
               {"components", components.size()},
               {"keyframes", map.keyframes.size()},
               {"views", views},
               {"features", features},
               {"landmarks", map.landmarks.size()},
               {"constraints", map.place_graph.constraints.size()},
               {"loops_accepted", std::count_if(map.loops.begin(), map.loops.end(),
                                                [](const auto& loop) { return loop.accepted(); })},
               {"frames", map.frames.size()},
               {"posed", optimized.posed()},
               {"metric", map.metric},
               {"path_length", path_length(optimized)},
               {"file_bytes", sizes.file_bytes},
               {"features_bytes", sizes.features_bytes},
               {"views_bytes", sizes.views_bytes},
               {"landmarks_bytes", sizes.landmarks_bytes}};
  if (const auto& calibration = stored.origin.calibration) {
    info["image"] = {{"width", calibration->camera.width}, {"height", calibration->camera.height}};
    info["baseline_m"] = calibration->baseline_m;
  }
  return info;
}

void info(const InfoArguments& arguments) {
  const std::string path = map_path_of(arguments.map);
  const json info = describe_map(path, read_stored_map(arguments.map));
  if (arguments.as_json) {
    fmt::print("{}\n", info.dump(1));
    return;
  }
  const auto count = [&](const char* key) { return info[key].get<std::int64_t>(); };
  const auto megabytes = [&](const char* key) { return 1e-6 * info[key].get<double>(); };
  fmt::print("{}: schema {}, {}\n", path, count("schema"),
             info["finished"].get<bool>() ? "finished" : "broken off");
  fmt::print("  from     {} ({})\n", info["sequence"].get<std::string>(),
             info["sensor"].get<std::string>());
  fmt::print("  places   {} in {} components, {} constraints, {} loops\n", count("places"),
             count("components"), count("constraints"), count("loops_accepted"));
  fmt::print("  frames   {}, {} posed, {} keyframes, path {:.1f} {}\n", count("frames"),
             count("posed"), count("keyframes"), info["path_length"].get<double>(),
             info["metric"].get<bool>() ? "m" : "units");
  fmt::print("  content  {} features, {} views, {} landmarks\n", count("features"), count("views"),
             count("landmarks"));
  fmt::print("  size     {:.1f} MB: features {:.1f}, views {:.1f}, landmarks {:.1f}\n",
             megabytes("file_bytes"), megabytes("features_bytes"), megabytes("views_bytes"),
             megabytes("landmarks_bytes"));
}

/// What reading alone does not check: the file's own structure, frames that others name, and
/// whether a run could go on from it.
void validate(const InfoArguments& arguments) {
  const std::string path = map_path_of(arguments.map);
  if (const std::string found = check_map_file(path); found != "ok")
    throw FileError(path, "is damaged: " + found);
  const StoredMap stored = read_map(path);
  const Map& map = stored.map;
  std::set<std::int64_t> frames;
  for (const FrameRecord& record : map.frames) frames.insert(record.frame);
  for (const Keyframe& keyframe : map.keyframes)
    if (!frames.count(keyframe.frame))
      throw FileError(path, fmt::format("table keyframe, row {}: frame {} is no frame of the map",
                                        keyframe.id, keyframe.frame));
  for (std::size_t i = 0; i < map.loops.size(); ++i)
    if (!frames.count(map.loops[i].query_frame) || !frames.count(map.loops[i].match_frame))
      throw FileError(path, fmt::format("table loop, row {}: frames {} and {} are not both of the "
                                        "map",
                                        i, map.loops[i].query_frame, map.loops[i].match_frame));
  (void)map.trajectory_optimized();
  if (!stored.history.keyframes.empty()) {
    try {
      (void)PlaceMapper(PlaceOptions(), IncrementalOptions(), map.place_graph.places,
                        stored.history);
    } catch (const ArgumentError& error) {
      throw FileError(path, std::string("tables link, part, place: ") + error.what());
    }
  }
  if (arguments.as_json)
    fmt::print("{}\n", json{{"valid", true},
                            {"finished", stored.finished},
                            {"places", map.place_graph.places.size()},
                            {"frames", map.frames.size()}}
                           .dump(1));
  else
    fmt::print("{}: valid, {}, {} places, {} frames\n", path,
               stored.finished ? "finished" : "broken off", map.place_graph.places.size(),
               map.frames.size());
}

void export_map(const ExportArguments& arguments) {
  const std::vector<ExportForm> forms = export_forms();
  require(std::any_of(arguments.paths.begin(), arguments.paths.end(),
                      [](const std::string& path) { return !path.empty(); }),
          "map export: nothing to write; see --help for the forms");
  for (const std::string& path : arguments.paths)
    if (!path.empty()) require_free(path, arguments.force);
  const StoredMap stored = read_stored_map(arguments.map);
  for (std::size_t i = 0; i < forms.size(); ++i) {
    if (arguments.paths[i].empty()) continue;
    if (forms[i].needs_poses && !stored.origin.calibration)
      throw NoAnswer(arguments.map +
                     ": a map of images without a camera has no poses to write to " +
                     arguments.paths[i]);
    forms[i].write(arguments.paths[i], stored);
  }
}

void add_info_commands(CLI::App& map) {
  const auto add = [&](const char* name, const char* what, void (*run)(const InfoArguments&)) {
    auto arguments = std::make_shared<InfoArguments>();
    CLI::App* command = map.add_subcommand(name, what);
    command->footer(fmt::format("placegraph map {} out/town", name));
    command->add_option("MAP", arguments->map, "map.db, or the folder of placegraph run with it")
        ->required();
    command->add_flag("--json", arguments->as_json, "for machines");
    command->callback([arguments, run] { run(*arguments); });
  };
  add("info", "What a saved map holds.", info);
  add("validate", "Whether a saved map is whole: every row, reference and number.", validate);
}

void add_export_command(CLI::App& map) {
  auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command = map.add_subcommand("export", "Parts of a saved map as files of their own.");
  command->footer("placegraph map export out/town --g2o graph.g2o --tum trajectory.tum");
  command->add_option("MAP", arguments->map, "map.db, or the folder of placegraph run with it")
      ->required();
  const std::vector<ExportForm> forms = export_forms();
  arguments->paths.resize(forms.size());
  for (std::size_t i = 0; i < forms.size(); ++i)
    command->add_option(forms[i].flag, arguments->paths[i], "file for " + forms[i].help);
  command->add_flag("--force", arguments->force, "overwrite files");
  command->callback([arguments] { export_map(*arguments); });
}

}  // namespace

void add_map_command(CLI::App& app) {
  CLI::App* map = app.add_subcommand("map", "Saved maps: learn, label, look at, check, export.");
  map->footer("placegraph map info out/town");
  map->require_subcommand(1);
  add_info_commands(*map);
  add_export_command(*map);
  add_map_learn_command(*map);
  add_map_label_command(*map);
  add_map_plan_command(*map);
  add_map_semantic_command(*map);
}

}  // namespace placegraph::apps
