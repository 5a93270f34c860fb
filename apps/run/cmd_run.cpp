#include "apps/run/cmd_run.h"

#include <placegraph/frontend/places/cues/place_cue_options.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/report/run_page.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "apps/run/run.h"
#include "apps/server/cmd_viewer_options.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

struct RunCommand {
  RunArguments arguments;
  bool json = false, profile = false;
  std::string page;   // file of the page that shows the run; empty: none
  bool view = false;  // whether the run is shown while it goes on
  ViewerOptions viewer;
  RunPresentation presentation;
};

/// A name for a run before its sequence is opened.
std::string title_of(const RunArguments& arguments) {
  const std::filesystem::path path(arguments.sequence.empty() ? arguments.resume
                                                              : arguments.sequence);
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

std::string verdict_of(const RunReport& report) {
  const auto found = report.summary.find("judgement");
  return found == report.summary.end() ? "" : found->value("verdict", "");
}

void run_and_print(const RunCommand& command) {
  if (!command.page.empty()) require_page_name(command.page);
  if (!command.page.empty() && std::filesystem::exists(command.page))
    require_free(command.page, command.arguments.force);
  RunArguments arguments = command.arguments;
  std::unique_ptr<RunDisplay> display;
  if (command.view) {
    display = command.presentation.show(command.viewer, title_of(arguments));
    arguments.watcher = &display->watcher();
  }
  const RunReport report = run(arguments);
  print(command.json ? to_json(report) : to_text(report));
  if (command.profile && !command.json) print(stages_text(report));
  if (!command.page.empty() && !report.broken_off)
    command.presentation.write_page(report.out, command.page);
  finish_printing();
  if (display && !report.interrupted) display->finish(report.out, verdict_of(report));
  if (report.broken_off) throw Error(*report.broken_off);
  if (report.interrupted) throw Interrupted(*report.interrupted);
  if (report.no_result) throw NoResult(*report.no_result);
}

void add_verbosity(CLI::App& command, Verbosity& verbosity) {
  const auto add = [&](const char* name, Verbosity value, const char* what) {
    return command.add_flag_callback(
        name, [&verbosity, value] { verbosity = value; }, what);
  };
  auto* quiet = add("--quiet", Verbosity::kQuiet, "print warnings and errors only");
  auto* verbose =
      add("--verbose", Verbosity::kVerbose, "print all events and informative messages");
  auto* debug = add("--debug", Verbosity::kDebug, "print every message with its time and level");
  verbose->excludes(quiet);
  debug->excludes(quiet)->excludes(verbose);
}

void add_recognizer(CLI::App& command, RunArguments& arguments) {
  auto* recognizer = command.add_option("--recognizer", arguments.recognizer, kRecognizerText);
  command.add_option("--appearance", arguments.appearance, kAppearanceText)
      ->delimiter(',')
      ->check(CLI::IsMember(place_cue_names()))
      ->needs(recognizer);
}

/// `--scene`, by which floor plan and street map were chosen before there was `--elements`.
void add_old_scene(CLI::App& command, std::optional<std::string>& scene) {
  command
      .add_option_function<std::string>(
          "--scene",
          [&scene](const std::string& names) {
            note("'--scene' is an old spelling; use '--elements', or '--config floor_plan'");
            scene = names;
          },
          "old spelling")
      ->group("");
}

}  // namespace

void add_run_command(CLI::App& app, const RunPresentation& presentation) {
  auto run_command = std::make_shared<RunCommand>();
  run_command->presentation = presentation;
  RunArguments& a = run_command->arguments;
  CLI::App* command =
      app.add_subcommand("run", "Estimate the trajectory and the place graph of a sequence");
  command->footer("placegraph run kitti/sequences/00 --out out/kitti00");
  command->add_option("SEQUENCE", a.sequence, "folder or video; see docs/datasets.md")
      ->type_name(kInput);
  command->add_option("-o,--out", a.out, "folder for the results")->type_name(kOutput);
  command->add_option("--resume", a.resume, "continue the unfinished run in this folder")
      ->type_name(kOutput);
  command->add_option("--sensor", a.sensor, kSensorText)
      ->check(CLI::IsMember({"auto", "mono", "stereo", "rgbd"}));
  command->add_option("--cues", a.cues,
                      "image evidence for the motion, joined by commas: points, lines, plane, "
                      "manhattan, direct; default: points,plane");
  command->add_option("--elements", a.elements,
                      "modules to use, joined by commas: motion, spatial, geometry, context, "
                      "semantics; default: as the options say");
  add_old_scene(*command, a.scene);
  command->add_option("--camera-height", a.camera_height_m, kCameraHeightText);
  command
      ->add_option("--mask", a.mask,
                   "grey image of the images' size; where it is 0, the (left) images are not "
                   "used")
      ->type_name(kInput);
  command
      ->add_option("--odometry", a.odometry,
                   "motion by other sensors (wheels, laser, IMU); see docs/other_sensors.md")
      ->type_name(kInput);
  add_recognizer(*command, a);
  command->add_option("--config", a.config, kConfigText)->type_name(kInputFile);
  command->add_option("--set", a.settings, kSetText)->allow_extra_args(false);
  command
      ->add_option("--min-posed", a.min_posed,
                   "share of the frames that must have a pose; exit code 1 below it")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_flag("--no-loops", a.no_loops, "disable loop closure");
  command->add_option("--seed", a.seed, kSeedText);
  command->add_option("--threads", a.threads, kThreadsText);
  command->add_flag("--json", run_command->json, kJsonText);
  command->add_flag("--force", a.force, kForceText);
  command
      ->add_option("--draw", a.draw,
                   "folder for the images, drawn with tracks and residuals; a video of them (.avi, "
                   ".mp4), or a contact sheet (.jpg, .png)")
      ->type_name(kOutput);
  command->add_flag("--profile", run_command->profile, kProfileText);
  command->add_option("--report", run_command->page, kReportText)->type_name(kOutput);
  auto* view =
      command->add_flag("--view", run_command->view, "show the run in a browser while it goes on");
  add_viewer_options(*command, run_command->viewer);
  for (const char* name : {"--port", "--open"}) command->get_option(name)->needs(view);
  add_verbosity(*command, a.verbosity);
  command->callback([run_command] { run_and_print(*run_command); });
}

}  // namespace placegraph::apps
