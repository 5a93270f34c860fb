#include "apps/train/cmd_train_planarity.h"

#include <placegraph/io/synthetic/worlds/synthetic_world.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/support/option_texts.h"
#include "apps/support/output.h"
#include "apps/train/train_planarity.h"

namespace placegraph::apps {

void add_train_planarity_command(CLI::App& train_command) {
  auto arguments = std::make_shared<TrainPlanarityArguments>();
  auto json = std::make_shared<bool>(false);
  TrainPlanarityArguments& a = *arguments;
  CLI::App* command = train_command.add_subcommand(
      "planarity",
      "Train the classifier of planar segments of point clouds: for `image planes --model`");
  command->footer("placegraph train planarity --out planarity.txt --clouds 300");
  command
      ->add_option("-o,--out", a.out, "file for the model")
      ->type_name(kOutput)
      ->required();
  command->add_option("--worlds", a.worlds, "rendered worlds of the training set")
      ->transform(CLI::Transformer(std::map<std::string, std::string>{{"hover", "flight"}}))
      ->check(CLI::IsMember(SyntheticWorld::worlds()))
      ->capture_default_str();
  command->add_option("--frames", a.frames, "number of frames rendered of each world")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command
      ->add_option("--clouds", a.clouds,
                   "generated clouds with curved surfaces and heaps; every fourth is left out and "
                   "judged")
      ->check(CLI::Range(10, 100000))
      ->capture_default_str();
  command->add_option("--rounds", a.rounds, "number of decision stumps")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("--seed", a.seed, kSeedText)->capture_default_str();
  command->add_flag("--json", *json, kJsonText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments, json] {
    const TrainPlanarityResult result = train_planarity(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
