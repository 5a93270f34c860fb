#include "apps/lines/cmd_vanishing.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/lines/vanishing.h"
#include "apps/support/calib_option.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_vanishing_command(CLI::App& app) {
  auto arguments = std::make_shared<VanishingArguments>();
  auto json = std::make_shared<bool>(false);
  VanishingArguments& a = *arguments;
  CLI::App* command = app.add_subcommand(
      "vanishing", "Find in which directions the straight edges of an image point");
  command->footer("placegraph vanishing segments.txt --calib K.txt --json");
  command->add_option("LINES", a.in, "lines of u1 v1 u2 v2 [px]; further columns are not read")
      ->required()
      ->check(CLI::ExistingFile);
  add_calib_option(*command, a.calib, kCalibFile)->required();
  command
      ->add_option("--noise", a.options.points.noise.end_px,
                   "of the ends of segments, about; it is estimated [px]")
      ->capture_default_str();
  command->add_option("--max-points", a.options.points.max_points, "vanishing points looked for")
      ->capture_default_str();
  command->add_option("--seed", a.seed, "of the random samples")->capture_default_str();
  command->add_flag("--json", *json, "print JSON");
  command->callback([arguments, json] {
    const VanishingResult result = vanishing(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
