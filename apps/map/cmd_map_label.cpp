#include "apps/map/cmd_map_label.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/map/map_label.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_map_label_command(CLI::App& map) {
  auto arguments = std::make_shared<MapLabelArguments>();
  auto json = std::make_shared<bool>(false);
  MapLabelArguments& a = *arguments;
  CLI::App* command = map.add_subcommand(
      "label", "Label the places of a saved map by a classifier trained on labelled images");
  command->footer("placegraph map label out/office rooms --names rooms/names.txt");
  command->add_option("MAP", a.map, kMapText)->type_name(kInput)->required();
  command
      ->add_option("ROOMS", a.house, "a folder with images and labels.txt (`image label` a line)")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--range", a.range, kRangeText)->expected(2);
  command->add_option("--names", a.names, "one name a line, the first of label 0")
      ->check(CLI::ExistingFile);
  command
      ->add_option("--min-probability", a.options.min_probability,
                   "smallest mean probability of a label")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_flag("--json", *json, kJsonText);
  command->callback([arguments, json] {
    const MapLabelResult result = map_label(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
