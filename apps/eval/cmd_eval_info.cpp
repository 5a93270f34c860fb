#include "apps/eval/cmd_eval_info.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/eval/eval_info.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_eval_info_command(CLI::App& eval_group) {
  auto arguments = std::make_shared<EvalInfoArguments>();
  auto json = std::make_shared<bool>(false);
  CLI::App* command = eval_group.add_subcommand(
      "info", "Describe trajectories without ground truth: rate, gaps, stops, jumps, conventions");
  command->footer("placegraph eval info trajectory.tum --json");
  command
      ->add_option("TRAJECTORY", arguments->files,
                   "trajectories, or folders of sequences with ground truth")
      ->required()
      ->check(CLI::ExistingPath);
  command->add_option("--times", arguments->times, kTimesText)->check(CLI::ExistingFile);
  command->add_option("--apply", arguments->apply, kApplyText);
  command->add_flag("--json", *json, kJsonText);
  command->callback([arguments, json] {
    const std::vector<NamedInfo> infos = eval_info(*arguments);
    print(*json ? to_json(infos) : to_text(infos));
  });
}

}  // namespace placegraph::apps
