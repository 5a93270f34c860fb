#include "apps/image/planes/cmd_planes.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/image/planes/cmd_planes_cloud.h"
#include "apps/image/planes/planes_two_view.h"
#include "apps/support/calib_option.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_two_view_planes_command(CLI::App& image) {
  auto arguments = std::make_shared<PlanesTwoViewArguments>();
  auto json = std::make_shared<bool>(false);
  PlanesTwoViewArguments& a = *arguments;
  CLI::App* command = image.add_subcommand("two-view-planes",
                                           "Label the point matches of two views by their planes");
  command->footer(
      "placegraph image two-view-planes matches.txt --out labels.txt --calib K.txt "
      "--motion motion.json");
  command->add_option("MATCHES", a.in, "lines of xA yA xB yB [px]; further columns are not read")
      ->required()
      ->check(CLI::ExistingFile);
  command
      ->add_option("-o,--out", a.out,
                   "file for one label per match: 0 no plane, 1 the largest plane")
      ->type_name(kOutput)
      ->required();
  add_calib_option(*command, a.calib,
                   std::string("camera of both views: also the motion; ") + kCalibFile);
  command
      ->add_option("--motion", a.motion, "JSON file for the motion and the planes")
      ->type_name(kOutput);
  command->add_option("--noise", a.regions.noise_px, "approximate noise of the measurements [px]")
      ->capture_default_str();
  command
      ->add_option("--min-matches", a.regions.min_matches, "smallest number of matches of a plane")
      ->capture_default_str();
  command->add_option("--seed", a.seed, kSeedText)->capture_default_str();
  command->add_flag("--json", *json, kJsonText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments, json] {
    const PlanesTwoViewResult result = planes_two_view(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
