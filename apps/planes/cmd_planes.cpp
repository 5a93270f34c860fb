#include "apps/planes/cmd_planes.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/planes/cmd_planes_cloud.h"
#include "apps/planes/planes_two_view.h"
#include "apps/support/calib_option.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_planes_command(CLI::App& app) {
  CLI::App* planes =
      app.add_subcommand("planes", "Planes in a point cloud, or behind the matches of two views");
  planes->footer("placegraph planes depth.png --calib K.txt --depth-scale 0.001 --out planes.png");
  planes->require_subcommand(0, 1);
  add_cloud_planes(*planes);
  auto arguments = std::make_shared<PlanesTwoViewArguments>();
  auto json = std::make_shared<bool>(false);
  PlanesTwoViewArguments& a = *arguments;
  CLI::App* command = planes->add_subcommand(
      "two-view", "Label the point matches of two views by the plane they lie on");
  command->footer(
      "placegraph planes two-view matches.txt --out labels.txt --calib K.txt "
      "--motion motion.json");
  command->add_option("MATCHES", a.in, "lines of xA yA xB yB [px]; further columns are not read")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("-o,--out", a.out, "one label a match: 0 on no plane, 1 the largest plane")
      ->required();
  add_calib_option(*command, a.calib,
                   std::string("camera of both views: also the motion; ") + kCalibFile,
                   "--calibration");
  command->add_option("--motion", a.motion, "motion and planes as JSON");
  command->add_option("--noise", a.regions.noise_px, "of a match, about [px]")
      ->capture_default_str();
  command->add_option("--min-matches", a.regions.min_matches, "a plane with fewer is none")
      ->capture_default_str();
  command->add_option("--seed", a.seed, "of the random samples")->capture_default_str();
  command->add_flag("--json", *json, "print JSON");
  command->add_flag("--force", a.force, "overwrite outputs");
  command->callback([arguments, json] {
    const PlanesTwoViewResult result = planes_two_view(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
