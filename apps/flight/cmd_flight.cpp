#include "apps/flight/cmd_flight.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/flight/fly.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

struct FlightCommand {
  FlightArguments arguments;
  bool json = false, profile = false;
};

void fly_and_print(const FlightCommand& command) {
  const FlightResult result = fly(command.arguments);
  print(command.json ? to_json(result) : to_text(result));
  if (command.profile && !command.json) print(stages_text(result));
  if (result.no_result) throw NoResult(*result.no_result);
}

}  // namespace

void add_flight_command(CLI::App& flight) {
  auto flight_command = std::make_shared<FlightCommand>();
  FlightArguments& a = flight_command->arguments;
  CLI::App* command = flight.add_subcommand(
      "run", "Estimate the states of a flying robot from flow, an IMU and markers");
  command->footer("placegraph flight run out/flight --out out/states");
  command
      ->add_option("FLIGHT", a.flight, "folder in EuRoC's layout with imu0; see docs/flight.md")
      ->type_name(kInput)
      ->required();
  command
      ->add_option("-o,--out", a.out, "folder for the results")
      ->type_name(kOutput)
      ->required();
  command
      ->add_option("--markers", a.markers,
                   "layout of markers and beacons; default: FLIGHT/markers.yaml")
      ->type_name(kInput);
  auto* none = command->add_flag("--no-markers", a.no_markers, "ignore markers");
  command
      ->add_option("--markers-until", a.markers_until_s,
                   "use markers during the first seconds only [s]")
      ->excludes(none);
  command->add_option("--blind", a.blind, "FROM:TO, interval without markers [s]; may be repeated")
      ->allow_extra_args(false)
      ->excludes(none);
  auto* map = command->add_flag("--map-markers", a.map_markers,
                                "estimate the poses of markers that the layout does not give; "
                                "OUT/markers.yaml has all markers");
  map->excludes(none);
  command
      ->add_option("--truth-markers", a.true_markers, "true layout, to evaluate the estimated one")
      ->check(CLI::ExistingFile)
      ->needs(map);
  command->add_flag("--start-from-truth", a.start_from_truth,
                    "initialize with the first true state instead of the first marker");
  command
      ->add_option("--predict-ahead-ms", a.predict_ahead_ms,
                   "predict the states this long after their image [ms]")
      ->capture_default_str();
  command->add_flag("--smooth", a.smooth,
                    "also estimate the states by a fixed-lag smoother of one second");
  command->add_option("--config", a.config, kConfigText)->type_name(kInputFile);
  command->add_option("--set", a.settings, kSetText)->allow_extra_args(false);
  command->add_flag("--json", flight_command->json, kJsonText);
  command->add_flag("--profile", flight_command->profile, kProfileText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([flight_command] { fly_and_print(*flight_command); });
}

}  // namespace placegraph::apps
