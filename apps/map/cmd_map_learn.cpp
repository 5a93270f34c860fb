#include "apps/map/cmd_map_learn.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/map/map_learn.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_map_learn_command(CLI::App& map) {
  auto arguments = std::make_shared<MapLearnArguments>();
  MapLearnArguments& a = *arguments;
  CLI::App* command = map.add_subcommand(
      "learn", "Make a map for recognition alone, from images without a calibration");
  command->footer("placegraph map learn places/corridor --range 0 110 --out corridor.db");
  command->add_option("IMAGES", a.images, "a folder of images in the order they were taken")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("-o,--out", a.out, "file for the map")->type_name(kOutput)->required();
  command->add_option("--range", a.range, kRangeText)->expected(2);
  command->add_option("--set", a.settings, kSetText)->type_size(1)->allow_extra_args(false);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments] { print(to_text(map_learn(*arguments))); });
}

}  // namespace placegraph::apps
