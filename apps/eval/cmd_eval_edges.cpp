#include "apps/eval/cmd_eval_edges.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/eval/eval_edges.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_eval_edges_command(CLI::App& eval_group) {
  auto arguments = std::make_shared<EvalEdgesArguments>();
  auto json = std::make_shared<bool>(false), axes = std::make_shared<bool>(false);
  EvalEdgesArguments& a = *arguments;
  CLI::App* command = eval_group.add_subcommand(
      "edges", "Compare the errors of a place graph's edges with their stated covariances");
  command->footer("placegraph eval edges town/poses.txt out/town-run");
  command
      ->add_option("TRUTH", a.truth,
                   "true poses of every frame of the sequence (or its folder with poses.txt)")
      ->required()
      ->check(CLI::ExistingPath);
  command->add_option("RUN", a.run, "folder written by `placegraph run`")
      ->required()
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("--truth-noise", a.truth_noise,
                   "noise of the true poses: none, estimate (from the poses alone, see `eval "
                   "noise`), or POSITION_M,ROTATION_DEG (white noise of each pose)")
      ->capture_default_str();
  command->add_flag("--fit-mount", a.fit_mount,
                    "fit the camera's pose in the frame of the truth first, which a calibration of "
                    "the truth's sensor may have wrong");
  command->add_flag("--axes", *axes, "print the errors of every axis, too");
  command->add_flag("--json", *json, kJsonText);
  command->callback([arguments, json, axes] {
    const EvalEdgesResult result = eval_edges(*arguments);
    print(*json ? to_json(result) : to_text(result, *axes));
  });
}

}  // namespace placegraph::apps
