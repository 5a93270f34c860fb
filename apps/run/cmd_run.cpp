#include "apps/run/cmd_run.h"

#include <placegraph/graph/core/error.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "apps/run/run.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

struct RunCommand {
  RunArguments arguments;
  bool json = false, verbose = false, profile = false;
};

void run_and_print(const RunCommand& command) {
  const LogSink log = [&](LogLevel level, const std::string& message) {
    if (level == LogLevel::kWarning || command.verbose)
      std::fprintf(stderr, "\n%s", message.c_str());
  };
  const RunReport report = run(command.arguments, log);
  print(command.json ? to_json(report) : to_text(report));
  if (command.profile && !command.json) print(stages_text(report));
  if (report.broken_off) throw Error(*report.broken_off);
  if (report.no_answer) throw NoAnswer(*report.no_answer);
}

}  // namespace

void add_run_command(CLI::App& app) {
  auto run_command = std::make_shared<RunCommand>();
  RunArguments* arguments = &run_command->arguments;
  CLI::App* command = app.add_subcommand("run", "Images in, trajectory and place graph out.");
  command->footer("placegraph run kitti/sequences/00 --camera-height 1.65 --out out/kitti00");
  command->add_option("SEQUENCE", arguments->sequence, "folder or video; see docs/datasets.md");
  command->add_option("-o,--out", arguments->out, "folder for the results");
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
  command->add_option("--set", arguments->settings, kSetText)
      ->allow_extra_args(false);
  command->add_flag("--no-loops", arguments->no_loops, "do not look for revisits");
  command->add_option("--seed", arguments->seed, kSeedText);
  command->add_option("--threads", arguments->threads, kThreadsText);
  command->add_flag("--json", run_command->json, kJsonText);
  command->add_flag("--force", arguments->force, kForceText);
  command->add_option("--draw", arguments->draw,
                      "folder for every frame drawn with tracks, residuals and ground");
  command->add_flag("--profile", run_command->profile, "print the CPU time of every stage");
  command->add_flag("--verbose", run_command->verbose, "log messages on stderr");
  command->callback([run_command] { run_and_print(*run_command); });
}

}  // namespace placegraph::apps
