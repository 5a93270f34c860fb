#include "apps/eval/cmd_eval_noise.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/eval/eval_noise.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_eval_noise_command(CLI::App& eval_group) {
  auto truth = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  CLI::App* command =
      eval_group.add_subcommand("noise", "Estimate the noise of true poses from the poses alone");
  command->footer("placegraph eval noise kitti/00/poses.txt");
  command->add_option("TRUTH", *truth, "true poses of every frame (or a folder with poses.txt)")
      ->required()
      ->check(CLI::ExistingPath);
  command->add_flag("--json", *json, kJsonText);
  command->callback([truth, json] {
    const EvalNoiseResult result = eval_noise(*truth);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
