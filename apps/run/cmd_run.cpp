#include "apps/run/cmd_run.h"

#include <placegraph/graph/core/error.h>
#include <placegraph/graph/place_transitions.h>
#include <placegraph/graph/pose_graph/rigid_graph.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/place_graph_export.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <placegraph/pipeline/elements.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>

#include "apps/results/environment_files.h"
#include "apps/results/floor_plan_files.h"
#include "apps/results/run_files.h"
#include "apps/results/run_judgement.h"
#include "apps/results/semantic_map_files.h"
#include "apps/run/draw_frame.h"
#include "apps/run/run_notes.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"
#include "apps/support/scene_models.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct RunArguments {
  std::string sequence, out, resume, config, odometry, draw;
  std::vector<std::string> settings;
  std::optional<std::string> sensor, cues, scene, elements;
  std::optional<double> camera_height_m;
  std::optional<std::int64_t> seed;
  std::optional<int> threads;
  bool no_loops = false, as_json = false, force = false, verbose = false, profile = false;
};

std::string map_path(const std::string& folder) { return (fs::path(folder) / "map.db").string(); }

/// "geometry,semantics", either alone, or "none".
void set_scene(const std::string& list, SceneOptions& options) {
  options.geometry = options.semantics = false;
  std::vector<std::string_view> names;
  split_comma(list, names);
  for (const std::string_view name : names) {
    require(name == "geometry" || name == "semantics" || (name == "none" && names.size() == 1),
            "--scene: " + in_quotes(name) + " is none of geometry, semantics; or none");
    options.geometry = options.geometry || name == "geometry";
    options.semantics = options.semantics || name == "semantics";
  }
}

/// Defaults (or what a run that goes on was begun with) < file < --set < explicit flags.
RunOptions options_of(const RunArguments& arguments, RunOptions options = {}) {
  if (arguments.scene) set_scene(*arguments.scene, options.scene);
  // What a plan asks of the motion gives way to all that is said of it.
  const bool begins = arguments.resume.empty();
  if (arguments.scene && options.scene.geometry && begins) steady_for_plan(options);
  if (!arguments.config.empty()) read_options(arguments.config, options);
  for (const std::string& setting : arguments.settings) set_option(options, setting);
  if (arguments.sensor) set_option(options, "sensor=" + *arguments.sensor);
  if (arguments.elements) set_elements(parse_elements(*arguments.elements), options);
  if (arguments.scene) set_scene(*arguments.scene, options.scene);
  if (arguments.cues) options.slam.odometry.cues = *arguments.cues;
  if (arguments.camera_height_m) {
    require(*arguments.camera_height_m > 0, "--camera-height: must be positive");
    options.camera_height_m = *arguments.camera_height_m;
  }
  if (!arguments.odometry.empty()) options.motion.file = arguments.odometry;
  if (arguments.seed) {
    require(*arguments.seed >= 0, "--seed: must not be negative");
    options.slam.seed = static_cast<std::uint64_t>(*arguments.seed);
  }
  if (arguments.threads) options.threads = *arguments.threads;
  if (arguments.no_loops) options.slam.loops.enabled = false;
  options.check();
  return options;
}

double cpu_seconds(const rusage& usage) {
  return usage.ru_utime.tv_sec + usage.ru_stime.tv_sec +
         1e-6 * (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

/// Ground truth of the sequence, if there is one pose for every frame.
const Trajectory* truth_of(const Dataset& dataset) {
  const auto& truth = dataset.ground_truth();
  return truth && truth->size() == dataset.size() ? &*truth : nullptr;
}

std::int64_t frames_to_run(const Dataset& dataset, const RunOptions& options) {
  const auto offered = static_cast<std::int64_t>(dataset.size()) - options.first_frame;
  return options.max_frames > 0 ? std::min<std::int64_t>(options.max_frames, offered) : offered;
}

void write_results(const std::string& folder, const RunResult& run, const Trajectory& optimized,
                   const Trajectory* truth, const std::string& title, const json& summary) {
  const auto path = [&](const char* name) { return (fs::path(folder) / name).string(); };
  fs::remove(path("result.json"));  // written last: it vouches for the others
  for (const auto& [trajectory, name] : {std::pair(&run.map.trajectory_online, "trajectory_online"),
                                         std::pair(&optimized, "trajectory_optimized")}) {
    write_trajectory(path((std::string(name) + ".tum").c_str()), *trajectory,
                     TrajectoryFormat::kTum);
    write_trajectory(path((std::string(name) + ".kitti").c_str()), *trajectory,
                     TrajectoryFormat::kKitti);
  }
  const PoseGraph graph = run.map.place_graph.pose_graph();
  write_g2o(path("graph.g2o"), graph);
  fs::remove(path("graph_se3.g2o"));
  if (graph.kind() == PoseKind::kSim3) write_g2o(path("graph_se3.g2o"), rigid_graph(graph));
  write_file(path("places.json"), places_json(run.map));
  const auto transitions = place_transitions(run.map);
  write_file(path("places.graphml"), to_graphml(run.map.place_graph, transitions));
  write_file(path("places.dot"), to_dot(run.map.place_graph, transitions));
  write_file(path("loops.csv"), loops_csv(run.map));
  write_file(path("plot.png"), run_plot(run, optimized, truth, title));
  write_file(path("result.json"), summary.dump(1) + "\n");
}

void print_summary(const json& summary, const std::string& folder) {
  std::printf("%-12s %s, %d of %d frames posed (%d online), %d keyframes, %d places, %d loops\n",
              summary["sequence"].get<std::string>().c_str(),
              summary["sensor"].get<std::string>().c_str(), summary["posed"].get<int>(),
              summary["frames"].get<int>(), summary["posed_online"].get<int>(),
              summary["keyframes"].get<int>(), summary["places"].get<int>(),
              summary["loops_accepted"].get<int>());
  for (const json& frames : summary["unposed"])
    std::printf("%-12s no pose: %s (%d %s)\n", "", frames["reason"].get<std::string>().c_str(),
                frames["frames"].get<int>(), frames["frames"] == 1 ? "frame" : "frames");
  if (summary.contains("motion") && summary["motion"]["median_deviation"].is_number())
    std::printf("%-12s motion by other sensors: %d constraints, %.2f times as far off as claimed\n",
                "", summary["motion"]["constraints"].get<int>(),
                summary["motion"]["median_deviation"].get<double>());
  if (summary.contains("evaluation"))
    for (const auto& [name, figures] : summary["evaluation"].items())
      if (figures.contains("ate_rmse_m") && figures["ate_rmse_m"].is_number())
        std::printf("%-12s ATE %.4f m (%s), path %.1f m\n", "", figures["ate_rmse_m"].get<double>(),
                    name.c_str(), summary["path_m"].get<double>());
  if (summary.contains("floor_plan") && summary["floor_plan"].contains("walls"))
    std::printf("%-12s floor plan: %d walls, %d doors, %d rooms\n", "",
                summary["floor_plan"]["walls"].get<int>(),
                summary["floor_plan"]["doors"].get<int>(),
                summary["floor_plan"]["rooms"].get<int>());
  if (summary.contains("semantic_map") && summary["semantic_map"].contains("cells"))
    std::printf("%-12s semantic map: %lld cells of %d keyframes\n", "",
                summary["semantic_map"]["cells"].get<long long>(),
                summary["semantic_map"]["keyframes"].get<int>());
  std::printf(
      "%-12s %.1f s, %.1f ms CPU a frame, results in %s\n", "", summary["wall_s"].get<double>(),
      1000 * summary["cpu_s"].get<double>() / summary["frames"].get<double>(), folder.c_str());
}

json describe_stages(const RunResult& run) {
  json stages = json::array();
  for (const StageTimes::Stage& stage : run.stages)
    stages.push_back({{"name", stage.name}, {"cpu_s", stage.cpu_s}, {"calls", stage.calls}});
  return stages;
}

void print_stages(const json& summary) {
  const double frames = std::max(1, summary["frames"].get<int>());
  std::printf("%-22s %9s %13s %13s\n", "stage", "calls", "CPU ms/call", "CPU ms/frame");
  for (const json& stage : summary["stages"]) {
    const double ms = 1000 * stage["cpu_s"].get<double>();
    const auto calls = stage["calls"].get<std::int64_t>();
    std::printf("%-22s %9lld %13.2f %13.2f\n", stage["name"].get<std::string>().c_str(),
                static_cast<long long>(calls), ms / static_cast<double>(calls), ms / frames);
  }
}

/// A run that was broken off goes on with the sequence and the options it was begun with; takes
/// them into `arguments`. Throws ArgumentError where a flag says otherwise.
RunOptions options_of_resumed(RunArguments& arguments) {
  require(arguments.out.empty() ||
              fs::weakly_canonical(arguments.out) == fs::weakly_canonical(arguments.resume),
          "--out: a run that goes on writes into the folder it is resumed from");
  arguments.out = arguments.resume;
  const std::string path = map_path(arguments.resume);
  if (!fs::exists(path))
    throw FileError(path, "is not there: nothing was saved that a run could go on from");
  const MapOrigin origin = read_map_origin(path);
  require(!origin.options.empty(), path + ": is no map of a run");
  require(arguments.sequence.empty() ||
              fs::weakly_canonical(arguments.sequence) == fs::weakly_canonical(origin.sequence),
          "--resume: the run was begun on " + origin.sequence);
  arguments.sequence = origin.sequence;
  RunOptions begun;
  read_options_text(path, origin.options, begun);
  RunOptions asked = options_of(arguments, begun);
  begun.threads = asked.threads;
  const auto was = list_options(begun), is = list_options(asked);
  for (std::size_t i = 0; i < was.size(); ++i)
    require(was[i].value == is[i].value, "--resume: the run was begun with " + was[i].path + ": " +
                                             was[i].value + ", not " + is[i].value);
  return asked;
}

/// What the run is to do, its output folder checked.
RunOptions prepare(RunArguments& arguments) {
  if (!arguments.resume.empty()) return options_of_resumed(arguments);
  require(!arguments.sequence.empty() && !arguments.out.empty(),
          "SEQUENCE and --out are needed, or --resume");
  const RunOptions options = options_of(arguments);
  require(arguments.force || !is_unfinished_map(map_path(arguments.out)),
          arguments.out +
              ": holds a run that was broken off; --resume goes on with it, --force "
              "begins anew");
  require_free_folder(arguments.out, arguments.force);
  return options;
}

/// The model of surfaces that labels are made with, where the run needs them.
std::shared_ptr<const SceneModel> surfaces_of(const SlamOptions& options) {
  if (!options.semantics.enabled && !options.context.enabled) return nullptr;
  return std::make_shared<const SceneModel>(load_scene_model(SceneModel::Kind::kSurfaces, ""));
}

/// Draws the floor plan and labels the places by its rooms; what result.json says of it. Where
/// there is no plan the run is good all the same.
json map_scene(const RunArguments& arguments, const RunOptions& options, const Dataset& dataset,
               RunResult& run) {
  const IndoorMap plan =
      plan_of_map(run.map, run.calibration, dataset, run.sensor, run.lens_k1, options.scene.indoor);
  if (plan.outcome) {
    label_places(plan, run.map.place_graph);
    save_labels(map_path(arguments.out), run.map.place_graph);
    write_floor_plan(arguments.out, plan, run.map, dataset.name());
  } else {
    warn("no floor plan: " + plan.outcome.reason);
  }
  return describe_floor_plan(plan, run.map, dataset, arguments.sequence);
}

/// Writes the map of the street; what result.json says of it. Where there is none the run is good
/// all the same.
json map_street(const RunArguments& arguments, const RunOptions& options, const Dataset& dataset,
                const RunResult& run) {
  const UrbanMapper mapper = urban_mapper_of(
      run.map, run.calibration, dataset, run.sensor, run.lens_k1, options.scene.urban,
      {options.scene.urban_model, options.scene.surfaces_model});
  const SemanticMap semantic = mapper.fuse(run.map);
  if (semantic.outcome)
    write_semantic_map(arguments.out, semantic, mapper, run.map, poses_of(run.map), dataset.name());
  else
    warn("no semantic map: " + semantic.outcome.reason);
  return describe_semantic_map(semantic, mapper, run.map, dataset, arguments.sequence);
}

void run(RunArguments arguments) {
  const RunOptions options = prepare(arguments);
  if (options.scene.semantics)
    check_urban_models(options.scene.urban,
                       {options.scene.urban_model, options.scene.surfaces_model});
  if (!arguments.draw.empty()) {
    require_free_folder(arguments.draw, arguments.force);
    require(fs::weakly_canonical(arguments.draw) != fs::weakly_canonical(arguments.out),
            "--draw: must be another folder than --out");
  }
  const auto dataset = open_dataset(arguments.sequence);
  std::vector<DataNote> notes = notes_of(*dataset, options);
  for (const DataNote& note : notes) warn(dataset->name() + ": " + note.text);
  const auto surfaces = surfaces_of(options.slam);
  const OutputFolder folder(arguments.out);
  std::optional<OutputFolder> drawings;
  FrameObserver observer;
  if (!arguments.draw.empty()) {
    drawings.emplace(arguments.draw);
    observer = [&](const Frame& frame, const FrameResult& result, const FrameView& view) {
      write_frame_drawing(arguments.draw, frame, result, view);
    };
  }
  cv::setNumThreads(options.threads);

  const auto begin = std::chrono::steady_clock::now();
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  RunResult run;
  {
    Progress progress("running " + dataset->name(), frames_to_run(*dataset, options));
    const LogSink log = [&](LogLevel level, const std::string& message) {
      if (level == LogLevel::kWarning || arguments.verbose)
        std::fprintf(stderr, "\n%s", message.c_str());
    };
    run = run_sequence(
        *dataset, options,
        [&](std::size_t done, std::size_t, const FrameResult&) {
          progress.update(static_cast<std::int64_t>(done));
        },
        log, observer,
        MapFile{map_path(arguments.out), fs::absolute(arguments.sequence).string(),
                !arguments.resume.empty()},
        surfaces);
  }
  json floor_plan, semantic_map;
  if (options.scene.geometry) floor_plan = map_scene(arguments, options, *dataset, run);
  if (options.scene.semantics) semantic_map = map_street(arguments, options, *dataset, run);
  getrusage(RUSAGE_SELF, &after);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;

  const Trajectory optimized = run.map.trajectory_optimized();
  json summary = describe_run(run, optimized);
  if (!options.motion.file.empty()) summary["motion"] = describe_motion(run.map.place_graph);
  if (!floor_plan.is_null()) summary["floor_plan"] = floor_plan;
  if (!semantic_map.is_null()) summary["semantic_map"] = semantic_map;
  if (!run.environments.empty()) {
    summary["environments"] = describe_environments(run.map.place_graph);
    write_file((fs::path(arguments.out) / "environment.csv").string(),
               environment_csv(run.environments));
  }
  if (run.resumed_at) summary["resumed_at"] = *run.resumed_at;
  for (const DataNote& note : notes_of_motion(run, optimized)) {
    warn(dataset->name() + ": " + note.text);
    notes.push_back(note);
  }
  add_notes(notes, summary);
  summary["unposed"] = describe_unposed(run);
  summary["sequence"] = dataset->name();
  summary["format"] = dataset->format();
  summary["seed"] = options.slam.seed;
  summary["threads"] = options.threads;
  summary["wall_s"] = wall.count();
  summary["cpu_s"] = cpu_seconds(after) - cpu_seconds(before);
  summary["peak_mb"] = peak_mb();
  summary["stages"] = describe_stages(run);
  const Trajectory* truth = truth_of(*dataset);
  if (truth) summary.update(judge_run(*truth, run, optimized));
  write_results(arguments.out, run, optimized, truth, dataset->name(), summary);
  if (arguments.as_json)
    std::printf("%s\n", summary.dump(1).c_str());
  else
    print_summary(summary, arguments.out);
  if (arguments.profile && !arguments.as_json) print_stages(summary);
  if (run.broken_off)
    throw Error(*run.broken_off + " (results of the " + std::to_string(optimized.size()) +
                " frames before it are in " + arguments.out + ")");
  if (optimized.posed() == 0)
    throw NoAnswer(arguments.sequence + ": no frame could be posed" + why_unposed(run));
}

}  // namespace

void add_run_command(CLI::App& app) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* command = app.add_subcommand("run", "Images in, trajectory and place graph out.");
  command->footer("placegraph run kitti/sequences/00 --camera-height 1.65 --out out/kitti00");
  command->add_option("SEQUENCE", arguments->sequence, "folder or video; see docs/datasets.md");
  command->add_option("--out", arguments->out, "folder for the results");
  command->add_option("--resume", arguments->resume,
                      "go on with the run in this folder that was broken off, as it was begun");
  command->add_option("--sensor", arguments->sensor, "what to run it as; default: the best it has")
      ->check(CLI::IsMember({"auto", "mono", "stereo", "rgbd"}));
  command->add_option("--cues", arguments->cues,
                      "what motion is seen by, joined by commas: points, lines, plane, manhattan, "
                      "direct; default: points,plane");
  command->add_option("--elements", arguments->elements,
                      "what navigation is made of, joined by commas: motion, spatial, geometry, "
                      "context, semantics; default: as the options say");
  command->add_option(
      "--scene", arguments->scene,
      "geometry: rectangular worlds and planes join the cues, and a floor plan with walls, doors "
      "and rooms is drawn (docs/indoor.md); semantics: what is where in a street "
      "(docs/urban_map.md); or both, joined by a comma");
  command->add_option("--camera-height", arguments->camera_height_m,
                      "height above the ground [m]: gives a single eye its scale");
  command->add_option("--odometry", arguments->odometry,
                      "motion by other sensors (wheels, laser, inertial); see docs/odometry.md");
  command->add_option("--config", arguments->config, "YAML file with options (configs/)");
  command->add_option("--set", arguments->settings, "one option, key=value; may be repeated")
      ->allow_extra_args(false);
  command->add_flag("--no-loops", arguments->no_loops, "do not look for revisits");
  command->add_option("--seed", arguments->seed, "of every random stream");
  command->add_option("--threads", arguments->threads, "the result does not depend on it");
  command->add_flag("--json", arguments->as_json, "print result.json");
  command->add_flag("--force", arguments->force, "write into a folder that is not empty");
  command->add_option("--draw", arguments->draw,
                      "folder for every frame drawn with tracks, residuals and ground");
  command->add_flag("--profile", arguments->profile, "print the CPU time of every stage");
  command->add_flag("--verbose", arguments->verbose, "log messages on stderr");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace placegraph::apps
