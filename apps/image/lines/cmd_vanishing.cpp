#include "apps/image/lines/cmd_vanishing.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/image/lines/vanishing.h"
#include "apps/support/calib_option.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_vanishing_command(CLI::App& image) {
  auto arguments = std::make_shared<VanishingArguments>();
  auto json = std::make_shared<bool>(false);
  VanishingArguments& a = *arguments;
  CLI::App* command = image.add_subcommand(
      "vanishing", "Find the vanishing points of the edges of an image (short: vanishing)");
  command->footer("placegraph image vanishing segments.txt --calib K.txt --json");
  command->add_option("LINES", a.in, "lines of u1 v1 u2 v2 [px]; further columns are not read")
      ->required()
      ->check(CLI::ExistingFile);
  add_calib_option(*command, a.calib, kCalibFile)->required();
  command
      ->add_option("--noise", a.options.points.noise.end_px,
                   "approximate noise of the measurements [px]")
      ->capture_default_str();
  command
      ->add_option("--max-points", a.options.points.max_points,
                   "largest number of vanishing points")
      ->capture_default_str();
  command->add_option("--seed", a.seed, kSeedText)->capture_default_str();
  command->add_flag("--json", *json, kJsonText);
  command->callback([arguments, json] {
    const VanishingResult result = vanishing(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
