#include "apps/eval/cmd_scene_check.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/eval/scene_check.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_eval_labels_command(CLI::App& eval_group) {
  CLI::App* command =
      eval_group.add_subcommand("labels", "Evaluate label images against annotated ones");
  command->footer("placegraph eval labels labels camvid/val");
  auto arguments = std::make_shared<SceneCheckArguments>();
  auto json = std::make_shared<bool>(false);
  SceneCheckArguments& a = *arguments;
  command
      ->add_option(
          "LABELS", a.labels,
          "folder of `image labels` or `image surfaces`; its confidences are evaluated too")
      ->required()
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("DATA", a.data, "folder with images/ and labels/, CLASSES.txt in it or above it")
      ->required()
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("--classes", a.classes, "CLASSES.txt of LABELS, if it differs from that of DATA")
      ->check(CLI::ExistingFile);
  command->add_flag("--surfaces", a.surfaces, "LABELS are classes of surfaces");
  command->add_flag("--confusion", a.confusion, "print the confusion matrix of pixels");
  command->add_flag("--json", *json, kJsonText);
  command->callback([arguments, json] {
    const SceneCheckResult result = scene_check(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
