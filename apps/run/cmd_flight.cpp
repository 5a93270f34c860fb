#include "apps/run/cmd_flight.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/run/hover.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

struct FlightCommand {
  FlightArguments arguments;
  bool json = false, profile = false;
};

void fly_and_print(const FlightCommand& command) {
  const FlightResult result = hover(command.arguments);
  print(command.json ? to_json(result) : to_text(result));
  if (command.profile && !command.json) print(stages_text(result));
  if (result.no_answer) throw NoAnswer(*result.no_answer);
}

}  // namespace

void add_flight_command(CLI::App& app) {
  auto flight_command = std::make_shared<FlightCommand>();
  FlightArguments& a = flight_command->arguments;
  CLI::App* command = app.add_subcommand(
      "hover", "Where a flying robot was, by flow, inertial sensor and markers.");
  command->footer("placegraph hover out/flight --out out/hover");
  command->add_option("FLIGHT", a.flight, "folder in EuRoC's layout with imu0; see docs/hover.md")
      ->required();
  command->add_option("--out", a.out, "folder for the results")->required();
  command->add_option("--markers", a.markers,
                      "where markers and beacons are; default: FLIGHT/markers.yaml");
  auto* none = command->add_flag("--no-markers", a.no_markers, "never look for markers");
  command
      ->add_option("--markers-until", a.markers_until_s,
                   "look for markers for so many seconds only")
      ->excludes(none);
  command
      ->add_option("--blind", a.blind,
                   "FROM:TO, seconds in which markers are not looked for; may be repeated")
      ->allow_extra_args(false)
      ->excludes(none);
  auto* map = command->add_flag("--map-markers", a.map_markers,
                                "find where the markers are whose place the layout does not give; "
                                "OUT/markers.yaml has them all");
  map->excludes(none);
  command->add_option("--true-markers", a.true_markers, "layout that the mapped ones are judged by")
      ->check(CLI::ExistingFile)
      ->needs(map);
  command->add_flag("--start-from-truth", a.start_from_truth,
                    "begin with the first true state instead of the first marker");
  command
      ->add_option("--predict-ahead-ms", a.predict_ahead_ms,
                   "tell states so long after their image, by what came until then")
      ->capture_default_str();
  command->add_flag("--smooth", a.smooth,
                    "also the smoother's states: the same measurements in a window of a second");
  command->add_option("--config", a.config, "YAML file with options; see docs/hover.md");
  command->add_option("--set", a.settings, "one option, key=value; may be repeated")
      ->allow_extra_args(false);
  command->add_flag("--json", flight_command->json, "print result.json");
  command->add_flag("--profile", flight_command->profile, "print the CPU time of every stage");
  command->add_flag("--force", a.force, "write into a folder that is not empty");
  command->callback([flight_command] { fly_and_print(*flight_command); });
}

}  // namespace placegraph::apps
