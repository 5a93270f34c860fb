#include "apps/run/run.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/place_transitions.h>
#include <placegraph/graph/pose_graph/rigid_graph.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/place_graph_export.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <placegraph/pipeline/exports/place_tables.h>
#include <placegraph/pipeline/recognizers/image_recognizer.h>
#include <placegraph/pipeline/results/run_results.h>
#include <sys/resource.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <opencv2/core/utility.hpp>

#include "apps/results/environment_files.h"
#include "apps/run/frame_drawings.h"
#include "apps/run/run_messages.h"
#include "apps/run/run_notes.h"
#include "apps/run/run_scene.h"
#include "apps/shipped/scene_models.h"
#include "apps/support/interruption.h"
#include "apps/support/output.h"
#include "apps/support/plot_file.h"
#include "apps/support/progress.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

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
  write_other_components(folder, run.map);
  write_file(path("places.json"), places_json(run.map));
  const auto transitions = place_transitions(run.map);
  write_file(path("places.graphml"), to_graphml(run.map.place_graph, transitions));
  write_file(path("places.dot"), to_dot(run.map.place_graph, transitions));
  write_file(path("loops.csv"), loops_csv(run.map));
  write_plot_beside(path("plot.png"), run_picture(run.map, optimized, truth, title));
  write_file(path("result.json"), json_text(summary, 1));
}

json describe_stages(const RunResult& run) {
  json stages = json::array();
  for (const StageTimes::Stage& stage : run.stages)
    stages.push_back({{"name", stage.name}, {"cpu_s", stage.cpu_s}, {"calls", stage.calls}});
  return stages;
}

/// The model of surfaces that labels are made with, where the run needs them.
std::shared_ptr<const SceneModel> surfaces_of(const SlamOptions& options) {
  if (!options.semantics.enabled && !options.context.enabled) return nullptr;
  return std::make_shared<const SceneModel>(load_scene_model(SceneModel::Kind::kSurfaces, ""));
}

/// What comes before the work: the sequence with its notes, the models, and the folders.
struct PreparedRun {
  RunArguments arguments;
  RunOptions options;
  std::unique_ptr<Dataset> dataset;
  std::vector<DataNote> notes;
  std::shared_ptr<const SceneModel> surfaces;
  std::shared_ptr<PlaceRetrieval> recognizer;  ///< of --recognizer; null: none
};

PreparedRun prepare(RunArguments arguments) {
  PreparedRun prepared;
  const RunOptions options = prepare_run(arguments);
  if (options.scene.semantics) check_street_models(options);
  if (!arguments.draw.empty()) require_free_drawings(arguments.draw, arguments.force);
  prepared.dataset = open_dataset(arguments.sequence);
  prepared.notes = notes_of(*prepared.dataset, options);
  if (const auto note = note_of_unused_imu(arguments.sequence)) prepared.notes.push_back(*note);
  for (const DataNote& note : prepared.notes) warn(prepared.dataset->name() + ": " + note.text);
  prepared.surfaces = surfaces_of(options.slam);
  // Opened by its name in this call alone, not by the options, which files may hold.
  if (!arguments.recognizer.empty())
    prepared.recognizer = make_recognizer(open_describer(arguments.recognizer, options.describer),
                                          options.describer, {});
  prepared.arguments = std::move(arguments);
  prepared.options = options;
  return prepared;
}

/// Runs the sequence with progress and messages on stderr.
RunResult run_prepared(const PreparedRun& prepared, const Interruption& interruption,
                       FrameDrawings* drawings) {
  const RunArguments& arguments = prepared.arguments;
  const Dataset& dataset = *prepared.dataset;
  RunInputs inputs;
  RunWatcher* watcher = arguments.watcher;
  const Verbosity verbosity = arguments.verbosity;
  Progress progress("running " + dataset.name(), frames_to_run(dataset, prepared.options));
  SlamEventsGroup events;
  if (watcher) {
    watcher->begin(dataset.name(),
                   static_cast<std::size_t>(frames_to_run(dataset, prepared.options)));
    events.add(watcher);
    inputs.stages = [&](const auto& stages) { watcher->stages_measured(stages); };
  }
  if (watcher || drawings)
    inputs.observer = [&](const Frame& frame, const FrameResult& result, const FrameView& view) {
      if (watcher) watcher->frame_seen(frame, result, view);
      if (drawings) drawings->add(frame, result, view);
    };
  if (verbosity != Verbosity::kQuiet)
    inputs.progress = [&](std::size_t done, std::size_t, const FrameResult&) {
      progress.update(static_cast<std::int64_t>(done));
    };
  RunMessages messages(verbosity, [&](const std::string& line) { progress.print(line); });
  inputs.log = messages.log();
  if (verbosity != Verbosity::kQuiet) events.add(&messages);
  if (!events.empty()) inputs.events = &events;
  inputs.stop = [&] {
    const auto requested = [&] { return interruption.requested(); };
    if (watcher) watcher->await_permission(requested);
    return requested();
  };
  inputs.map_file = {run_map_path(arguments.out), fs::absolute(arguments.sequence).string(),
                     !arguments.resume.empty()};
  inputs.surfaces = prepared.surfaces;
  inputs.recognizer = prepared.recognizer;
  return run_sequence(dataset, prepared.options, inputs);
}

/// Judges the run, with warnings of what its motion shows; run.map then says what the judgement
/// does of the metres.
Judgement judge_prepared(PreparedRun& prepared, RunResult& run, const Trajectory& optimized) {
  for (const DataNote& note : notes_of_motion(run, optimized)) {
    warn(prepared.dataset->name() + ": " + note.text);
    prepared.notes.push_back(note);
  }
  return judge(run, prepared.notes, prepared.arguments.min_posed);
}

/// What result.json says of the work; of its scene, its cost and its truth others say it.
json summarize(const PreparedRun& prepared, const RunResult& run, const Trajectory& optimized) {
  const RunOptions& options = prepared.options;
  const Dataset& dataset = *prepared.dataset;
  json summary = json::parse(run_json(run, optimized));
  if (!options.motion.file.empty())
    summary["motion"] = json::parse(motion_json(run.map.place_graph));
  if (!run.environments.empty())
    summary["environments"] = describe_environments(run.map.place_graph);
  if (run.resumed_at) summary["resumed_at"] = *run.resumed_at;
  add_notes(prepared.notes, summary);
  summary["unposed"] = describe_unposed(run);
  summary["sequence"] = dataset.name();
  summary["format"] = dataset.format();
  summary["seed"] = options.slam.seed;
  summary["threads"] = options.threads;
  summary["stages"] = describe_stages(run);
  return summary;
}

/// Time of the wall and of the processor since it was made.
class RunClock {
 public:
  RunClock() { getrusage(RUSAGE_SELF, &begin_usage_); }
  void stop() {
    getrusage(RUSAGE_SELF, &end_usage_);
    wall_ = std::chrono::steady_clock::now() - begin_;
  }
  void describe(json& summary) const {
    summary["wall_s"] = wall_.count();
    summary["cpu_s"] = cpu_seconds(end_usage_) - cpu_seconds(begin_usage_);
    summary["peak_mb"] = peak_mb();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  rusage begin_usage_{}, end_usage_{};
  std::chrono::duration<double> wall_{};
};

}  // namespace

RunReport run(const RunArguments& asked) {
  PreparedRun prepared = prepare(asked);
  const RunArguments& arguments = prepared.arguments;
  const RunOptions& options = prepared.options;
  const Dataset& dataset = *prepared.dataset;
  const OutputFolder folder(arguments.out);
  std::unique_ptr<FrameDrawings> drawings;
  if (!arguments.draw.empty())
    drawings = frame_drawings(arguments.draw, frames_to_run(dataset, options));
  cv::setNumThreads(options.threads);

  RunClock clock;
  const Interruption interruption;  // until the results are written
  RunResult run = run_prepared(prepared, interruption, drawings.get());
  if (run.stopped && run.map.frames.empty())
    throw Interrupted("interrupted before the first frame; nothing was written");
  if (drawings) drawings->finish();
  const Trajectory optimized = run.map.trajectory_optimized();
  const bool measured = run.map.metric;
  const Judgement judgement = judge_prepared(prepared, run, optimized);
  json floor_plan, semantic_map;
  if (options.scene.geometry && !run.stopped)
    floor_plan = add_floor_plan(arguments, options, dataset, run);
  if (options.scene.semantics && !run.stopped)
    semantic_map = add_street_map(arguments, options, dataset, run);
  clock.stop();

  RunReport report{arguments.out, summarize(prepared, run, optimized), {}, {}, {}};
  json& summary = report.summary;
  clock.describe(summary);
  if (!floor_plan.is_null()) summary["floor_plan"] = floor_plan;
  if (!semantic_map.is_null()) summary["semantic_map"] = semantic_map;
  if (!run.environments.empty())
    write_file((fs::path(arguments.out) / "environment.csv").string(),
               environment_csv(run.environments));
  const Trajectory* truth = truth_of(dataset);
  if (run.stopped) summary["interrupted"] = true;
  if (truth) summary.update(json::parse(truth_json(*truth, run, optimized)));
  if (measured && !judgement.metric) summary["scale_doubted"] = true;
  summary["judgement"] = json::parse(judgement_json(judgement));
  const std::string map_path = interrupted_map_path(run_map_path(arguments.out));
  if (fs::exists(map_path)) write_judgement(map_path, judgement);
  write_results(arguments.out, run, optimized, truth, dataset.name(), summary);
  if (run.broken_off)
    report.broken_off = *run.broken_off + " (results of the " + std::to_string(optimized.size()) +
                        " frames before it are in " + arguments.out + ")";
  else if (run.stopped)
    report.interrupted =
        fmt::format("interrupted after {} of {} frames; continue with: placegraph run --resume {}",
                    optimized.size(), frames_to_run(dataset, options), arguments.out);
  else if (optimized.posed() == 0)
    report.no_result = arguments.sequence + ": no frame could be posed" + why_unposed(run);
  else if (judgement.verdict == Verdict::kFailed)
    report.no_result =
        fmt::format("{}: {}, fewer than {:.3g} % (--min-posed){}", arguments.sequence,
                    judgement.findings.front().text, 100 * arguments.min_posed, why_unposed(run));
  return report;
}

}  // namespace placegraph::apps
