#include "apps/map/queries/cmd_georeference.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/map/queries/georeference.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_georeference_command(CLI::App& map) {
  auto arguments = std::make_shared<GeoreferenceArguments>();
  auto json = std::make_shared<bool>(false);
  GeoreferenceArguments& a = *arguments;
  CLI::App* command = map.add_subcommand("georeference", "Place a map on the earth by GPS");
  command->footer(
      "placegraph map georeference out/run --gps 2011_09_26_drive_0095_sync --out out/earth");
  command
      ->add_option("GRAPH", a.graph,
                   "folder written by `placegraph run` or its map.db, or a .g2o graph with --times")
      ->required()
      ->check(CLI::ExistingPath);
  command
      ->add_option("--gps", a.gps,
                   "OXTS: folder of KITTI raw, or oxts.txt beside its times_oxts.txt")
      ->type_name(kInput)
      ->required();
  command->add_option("-o,--out", a.out, "folder for the results")->type_name(kOutput)->required();
  command->add_option("--times", a.times, kTimesText)->type_name(kInput);
  command->add_option("--lever-arm", a.lever_arm,
                      "antenna in the nodes' frame, x,y,z [m] (camera: right, down, forward), or "
                      "estimate; default 0,0,0");
  command->add_option("--origin", a.origin,
                      "origin of the east-north-up frame: latitude,longitude,height [deg, m]; "
                      "default: the median of the fixes");
  command->add_option("--clock-offset", a.clock_offset,
                      "time added to the stamps of the fixes [s], or `estimate`; default 0");
  command->add_option("--set", a.settings, kSetText)->allow_extra_args(false);
  command->add_flag("--json", *json, kJsonText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments, json] {
    const GeoreferenceReport report = georeference(*arguments);
    print(*json ? to_json(report) : to_text(report));
  });
}

}  // namespace placegraph::apps
