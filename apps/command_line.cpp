#include "apps/command_line.h"

#include <placegraph/graph/text/spelling.h>
#include <placegraph/pipeline/run.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "apps/cmd_elements.h"
#include "apps/cmd_group.h"
#include "apps/config/cmd_config.h"
#include "apps/eval/cmd_eval.h"
#include "apps/eval/cmd_eval_edges.h"
#include "apps/eval/benchmarks/cmd_eval_kitti.h"
#include "apps/eval/cmd_eval_info.h"
#include "apps/eval/cmd_eval_noise.h"
#include "apps/eval/benchmarks/cmd_eval_table.h"
#include "apps/eval/benchmarks/cmd_eval_gate.h"
#include "apps/eval/cmd_eval_noise.h"
#include "apps/eval/benchmarks/cmd_eval_record.h"
#include "apps/eval/cmd_loops.h"
#include "apps/graph/cmd_bundle.h"
#include "apps/graph/cmd_convert.h"
#include "apps/graph/cmd_optimize.h"
#include "apps/help.h"
#include "apps/map/cmd_map.h"
#include "apps/map/loops/cmd_map_loops.h"
#include "apps/map/queries/cmd_explain.h"
#include "apps/map/queries/cmd_georeference.h"
#include "apps/map/queries/cmd_localize.h"
#include "apps/map/queries/cmd_route.h"
#include "apps/pages.h"
#include "apps/run/cmd_inspect.h"
#include "apps/run/cmd_report.h"
#include "apps/run/cmd_run.h"
#include "apps/shell/cmd_shell.h"
#include "apps/shell/cmd_tree.h"
#include "apps/shell/path_options.h"
#include "apps/shell/spellings.h"
#include "apps/synth/cmd_synth.h"
#include "apps/synth/cmd_synth_graph.h"
#include "apps/viewer/cmd_view.h"
#include "apps/viewer/run_view.h"

namespace placegraph::apps {
namespace {

void add_map_group(CLI::App& app) {
  CLI::App& map = add_group(app, "map", "Saved maps", "info out/town-run");
  add_map_commands(map);
  add_map_scene_commands(map);
  add_map_loops_commands(map);
  add_localize_command(map);
  add_explain_command(map);
  add_route_command(map);
  add_georeference_command(map);
}

void add_graph_group(CLI::App& app) {
  CLI::App& graph =
      add_group(app, "graph", "Pose graphs and bundles", "optimize sphere.g2o -o optimized.g2o");
  add_optimize_command(graph, write_optimize_page);
  add_bundle_command(graph);
  add_convert_command(graph);
}

void add_eval_group(CLI::App& app) {
  CLI::App& group = add_group(app, "eval", "Evaluation against ground truth",
                              "trajectory poses.txt trajectory_optimized.kitti --align se3");
  add_eval_trajectory_command(
      group, [](const EvalArguments& a, const EvalResult& r) { write_eval_page(a, r); });
  add_eval_table_command(group);
  add_eval_edges_command(group);
  add_eval_kitti_command(group);
  add_eval_noise_command(group);
  add_eval_info_command(group);
  add_eval_record_command(group, kProgram);
  add_eval_gate_command(group);
  add_eval_loops_command(
      group, [](const LoopsArguments& a, const LoopsResult& r) { write_loops_page(a, r); });
  add_eval_scene_commands(group);
}

void add_synth_group(CLI::App& app) {
  CLI::App& group = add_group(app, "synth", "Synthetic sequences and graphs",
                              "sequence town-loop --out out/town-loop");
  add_synth_sequence_command(group);
  add_synth_graph_command(group);
}

bool is_flag(const std::string& word) { return word.starts_with("-"); }

/// "; --set KEY=VALUE sets it" if a flag has the name of an option of a run.
std::string setting_of(const std::string& flag) {
  std::string key = flag.substr(flag.find_first_not_of('-'));
  std::ranges::replace(key, '-', '_');
  for (const OptionEntry& entry : list_options(RunOptions()))
    if (entry.type != "group" && entry.path.substr(entry.path.rfind('.') + 1) == key)
      return "; `--set " + entry.path + "=...` sets it";
  return "";
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option :
       command.get_options([](const CLI::Option* option) { return !option->get_group().empty(); }))
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> command_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* sub : commands_of(command)) names.push_back(sub->get_name());
  if (command.get_parent() == nullptr)
    for (const std::string& word : first_words())
      if (std::ranges::count(names, word) == 0) names.push_back(word);
  return names;
}

}  // namespace

std::unique_ptr<CLI::App> make_command_line() {
  auto app = std::make_unique<CLI::App>("Visual SLAM: trajectories, places and pose graphs.",
                                        "placegraph");
  app->formatter(std::make_shared<ExampleFormatter>());
  app->footer("placegraph run kitti/sequences/00 --out out/00");
  app->set_version_flag("--version", kProgram);
  app->require_subcommand(1);
  RunPresentation presentation;
  presentation.write_page = [](const std::string& folder, const std::string& file) {
    write_folder_page(folder, file);
  };
  presentation.show = [](const ViewerOptions& options, const std::string& title) {
    return std::make_unique<RunView>(options, title, kProgram);
  };
  add_run_command(*app, presentation);
  add_inspect_command(*app);
  add_report_command(*app);
  add_view_command(*app);
  add_config_command(*app);
  add_map_group(*app);
  add_eval_group(*app);
  add_graph_group(*app);
  add_places_group(*app);
  add_image_group(*app);
  add_track_group(*app);
  add_flight_group(*app);
  add_synth_group(*app);
  add_train_group(*app);
  add_shell_commands(*app);
  CLI::App* const parsed = app.get();
  app->parse_complete_callback([parsed] { require_distinct_paths(parsed_command(*parsed)); });
  return app;
}

std::string unknown_command(const CLI::App& app) {
  const CLI::App& command = parsed_command(app);
  const std::vector<std::string> words = app.remaining(true);
  if (words.empty() || is_flag(words.front()) || commands_of(command).empty()) return {};
  return "no command '" + words.front() + "'" + did_you_mean(words.front(), command_names(command));
}

std::string unknown_words(const CLI::App& app) {
  const CLI::App& command = parsed_command(app);
  const std::vector<std::string> words = app.remaining(true);
  if (words.empty()) return {};
  if (const std::string unknown = unknown_command(app); !unknown.empty()) return unknown;
  const auto flag = std::ranges::find_if(words, is_flag);
  if (flag != words.end()) {
    const std::string name = flag->substr(0, flag->find('='));
    const std::string similar = did_you_mean(name, option_names(command));
    const bool is_run = similar.empty() && command.get_name() == "run" && name.starts_with("--");
    return "no option '" + name + "'" + (is_run ? setting_of(name) : similar);
  }
  return "unexpected '" + words.front() + "'";
}

}  // namespace placegraph::apps
