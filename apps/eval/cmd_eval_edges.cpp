#include "apps/eval/cmd_eval_edges.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/eval/eval_edges.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_eval_edges_command(CLI::App& app) {
  auto arguments = std::make_shared<EvalEdgesArguments>();
  auto json = std::make_shared<bool>(false);
  EvalEdgesArguments& a = *arguments;
  CLI::App* command = app.add_subcommand(
      "eval-edges", "Judge whether the edges of a run's place graph know what they claim");
  command->footer("placegraph eval-edges town/poses.txt out/town");
  command
      ->add_option("GT", a.truth,
                   "true poses of every frame of the sequence (or its folder with poses.txt)")
      ->required()
      ->check(CLI::ExistingPath);
  command->add_option("RUN", a.run, "folder that placegraph run has written")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_flag("--json", *json, "print JSON");
  command->callback([arguments, json] {
    const EvalEdgesResult result = eval_edges(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
