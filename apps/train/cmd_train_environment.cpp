#include "apps/train/cmd_train_environment.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/support/option_texts.h"
#include "apps/support/output.h"
#include "apps/train/train_environment.h"

namespace placegraph::apps {

void add_train_environment_command(CLI::App& train_command) {
  auto arguments = std::make_shared<TrainEnvironmentArguments>();
  auto json = std::make_shared<bool>(false);
  TrainEnvironmentArguments& a = *arguments;
  CLI::App* command = train_command.add_subcommand(
      "environment",
      "Train the classifier of environments: frontend/scene/environment.txt");
  command->footer("placegraph train environment camvid --out environment.txt");
  command
      ->add_option("DATA", a.data,
                   "labelled images of streets and roads, also used for training")
      ->type_name(kInput);
  command
      ->add_option("-o,--out", a.out, "file for the model")
      ->type_name(kOutput)
      ->required();
  command->add_option("--seeds", a.seeds, "seeds of the rendered worlds of the training set")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--left-out", a.left_out, "seeds of the rendered worlds of the test set")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--frames", a.frames, "number of frames rendered of each world")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("--penalty", a.penalty, "penalty on the weights")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command->add_option("--model", a.model, kModelText)->type_name(kInput);
  command->add_flag("--json", *json, kJsonText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments, json] {
    const TrainEnvironmentResult result = train_environment(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
