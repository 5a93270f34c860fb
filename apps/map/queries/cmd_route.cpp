#include "apps/map/queries/cmd_route.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/map/queries/route.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_route_command(CLI::App& map) {
  auto arguments = std::make_shared<RouteArguments>();
  RouteArguments& a = *arguments;
  CLI::App* command = map.add_subcommand(
      "route", "Find the shortest path between two places of a map, and the path back");
  command->footer(
      "placegraph map route out/town-run --from 0 --to 40 --backtrack --out path.json --plot "
      "path.png");
  command->add_option("MAP", a.map, kMapText)->required()->check(CLI::ExistingPath);
  const auto place_option = [&](const char* name, PlaceId& place, const char* what) {
    command
        ->add_option_function<std::int64_t>(
            name, [&place](std::int64_t number) { place = PlaceId(number); }, what)
        ->required();
  };
  place_option("--from", a.from, "first place of the path");
  place_option("--to", a.to, "last place of the path");
  command->add_flag("--backtrack", a.backtrack,
                    "also print the path back, from the last place to the first");
  command
      ->add_option("-o,--out", a.out,
                   "JSON file for the path: relative poses between places, and the frame to "
                   "compare with at each")
      ->type_name(kOutput);
  command->add_option("--plot", a.plot, kPlotText)->type_name(kOutput);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments] { print(to_text(route(*arguments))); });
}

}  // namespace placegraph::apps
