#include "apps/train/cmd_train_scene.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/shipped/scene_models.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"
#include "apps/train/train_scene.h"

namespace placegraph::apps {
namespace {

/// Adds the options of the training of the forests.
void add_forest_options(CLI::App& command, SceneTrainingOptions& training) {
  command.add_option("--variants", training.variants, "variants of each image in other light")
      ->capture_default_str();
  command.add_option("--trees", training.forest.trees, "number of trees of each forest")
      ->capture_default_str();
  command
      .add_option("--min-leaf", training.forest.min_leaf,
                  "smallest number of superpixels in a leaf")
      ->capture_default_str();
  command.add_option("--tries", training.forest.tries, "number of features tried for a split")
      ->capture_default_str();
  command
      .add_option("--share-rows", training.forest.share_rows,
                  "share of the superpixels used for each tree")
      ->capture_default_str();
  command.add_option("--class-power", training.class_power, "classes are weighted by share^-power")
      ->capture_default_str();
}

}  // namespace

void add_train_scene_command(CLI::App& train_command, SceneModel::Kind kind, const char* about) {
  const std::string name = name_of(kind);
  CLI::App* command = train_command.add_subcommand(name, about);
  command->footer("placegraph train " + name + " camvid --out " + name +
                  ".pgscene --holdout 0001TP");
  auto arguments = std::make_shared<TrainSceneArguments>();
  auto json = std::make_shared<bool>(false);
  TrainSceneArguments& a = *arguments;
  command
      ->add_option("DATA", a.data,
                   "folder with CLASSES.txt, train/images/ and train/labels/; val/ is the test set")
      ->required()
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("-o,--out", a.out, "file for the model; its card is written beside it")
      ->type_name(kOutput)
      ->required();
  command->add_option("--holdout", a.holdout,
                      "sequence of the test set (file names up to the first '_')");
  command
      ->add_option("--update", a.update,
                   "model to extend by these data, which may have new classes")
      ->type_name(kInput);
  add_forest_options(*command, a.options.training);
  command
      ->add_option(
          "--rendered", a.options.rendered,
          "seeds of rendered towns for the training set, joined by commas; their classes are "
          "exact, and those of even seeds have traffic and bad light")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--rendered-frames", a.options.rendered_frames,
                   "number of views of each rendered world")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("--every", a.options.every, "use every n-th image")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--seed", a.options.training.forest.seed, kSeedText)->capture_default_str();
  command->add_option("--threads", a.options.threads, kThreadsText)
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command->add_flag("--ablation", a.ablation, "also evaluate each part of the model");
  command->add_flag("--json", *json, kJsonText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments, json, kind] {
    const LogSink sink = [](LogLevel, const std::string& message) { note(message); };
    const TrainSceneResult result = train_scene(*arguments, kind, sink);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
