#include "apps/map/cmd_route.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/map/route.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_route_command(CLI::App& app) {
  auto arguments = std::make_shared<RouteArguments>();
  RouteArguments& a = *arguments;
  CLI::App* command =
      app.add_subcommand("route", "The shortest way over the places of a map, or the way back");
  command->footer(
      "placegraph route out/town --from 0 --to 40 --backtrack --out way.json --plot way.png");
  command->add_option("MAP", a.map, "folder that placegraph run has written, or a map.db")
      ->required()
      ->check(CLI::ExistingPath);
  const auto place_option = [&](const char* name, PlaceId& place, const char* what) {
    command
        ->add_option_function<std::int64_t>(
            name, [&place](std::int64_t number) { place = PlaceId(number); }, what)
        ->required();
  };
  place_option("--from", a.from, "place the way begins at");
  place_option("--to", a.to, "place it leads to");
  command->add_flag("--backtrack", a.backtrack,
                    "then print the way back: the same places from the last to the first");
  command->add_option("--out", a.out,
                      "write the way as JSON: relative poses from place to place, the frame whose "
                      "view to expect at each");
  command->add_option("--plot", a.plot, "draw the places and the way (.png or .svg)");
  command->add_flag("--force", a.force, "overwrite files");
  command->callback([arguments] { print(to_text(route(*arguments))); });
}

}  // namespace placegraph::apps
