#include "apps/map/cmd_localize.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/map/localize.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_localize_command(CLI::App& app) {
  auto arguments = std::make_shared<LocalizeArguments>();
  LocalizeArguments& a = *arguments;
  CLI::App* command = app.add_subcommand("localize", "Place new images in a saved map.");
  command->footer("placegraph localize out/town images --out placed.txt --sequence");
  command->add_option("MAP", a.map, "map.db, or the folder of placegraph run with it")->required();
  command->add_option("IMAGES", a.images, "a folder of images, or a sequence")
      ->required()
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("--out", a.out,
                   "write `image place view probability stage [pose]`, one line an image")
      ->required();
  command->add_option("--range", a.range, "first and last image")->expected(2);
  command->add_flag("--sequence", a.sequence,
                    "the images follow each other: add the evidence of those before and after");
  command->add_option("--set", a.settings, "one option, key=value; may be repeated")
      ->type_size(1)
      ->allow_extra_args(false);
  command->add_flag("--json", a.as_json, "write and print JSON");
  command->add_flag("--force", a.force, "overwrite files");
  command->callback([arguments] {
    const LocalizeResult result = localize(*arguments);
    print(arguments->as_json ? to_json(result) : to_text(result));
    if (result.no_answer) throw NoAnswer(*result.no_answer);
  });
}

}  // namespace placegraph::apps
