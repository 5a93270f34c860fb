#include "apps/map/queries/cmd_localize.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/map/queries/localize.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_localize_command(CLI::App& map) {
  auto arguments = std::make_shared<LocalizeArguments>();
  LocalizeArguments& a = *arguments;
  CLI::App* command = map.add_subcommand("localize", "Localize new images in a saved map");
  command->footer("placegraph map localize out/town-run images --out placed.txt --sequence");
  command->add_option("MAP", a.map, kMapText)->type_name(kInput)->required();
  command->add_option("IMAGES", a.images, "a folder of images, or a sequence")
      ->required()
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("-o,--out", a.out,
                   "file for `image place view probability stage [pose]`, one line per image")
      ->type_name(kOutput)
      ->required();
  command->add_option("--range", a.range, kRangeText)->expected(2);
  command->add_flag("--sequence", a.sequence, kSequenceText);
  command->add_option("--set", a.settings, kSetText)->type_size(1)->allow_extra_args(false);
  command->add_flag("--json", a.as_json, kJsonText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments] {
    const LocalizeResult result = localize(*arguments);
    print(arguments->as_json ? to_json(result) : to_text(result));
    if (result.no_result) throw NoResult(*result.no_result);
  });
}

}  // namespace placegraph::apps
