// What a program says that is built without the library placegraph::elements: the commands of
// apps/cmd_elements.h, and what commands of the core make of a scene.
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/outcome.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/cmd_elements.h"
#include "apps/config/flight_config.h"
#include "apps/map/floor_planner.h"
#include "apps/map/queries/image_content.h"
#include "apps/run/run_scene.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

using nlohmann::json;

constexpr const char* kWithout =
    "this program was built without placegraph::elements (PLACEGRAPH_ELEMENTS=OFF)";

/// A command that takes any words and says that this program has not what it needs.
void add_missing(CLI::App& app, const std::string& name, const std::string& what) {
  CLI::App* command = app.add_subcommand(name, what + "; not in this program");
  command->prefix_command();
  command->callback([command, what] {
    std::string path = command->get_name();
    for (const CLI::App* up = command->get_parent(); up->get_parent() != nullptr;
         up = up->get_parent())
      path = up->get_name() + " " + path;
    throw ArgumentError(path + ": " + kWithout);
  });
}

}  // namespace

void add_places_group(CLI::App& app) { add_missing(app, "places", "Place recognition"); }
void add_image_group(CLI::App& app) {
  add_missing(app, "image", "Measurements in one or two images");
}
void add_track_group(CLI::App& app) { add_missing(app, "track", "Tracks through a sequence"); }
void add_flight_group(CLI::App& app) {
  add_missing(app, "flight", "State estimation of flying robots");
}
void add_train_group(CLI::App& app) {
  add_missing(app, "train", "Training of the models that come with the program");
}

void add_map_scene_commands(CLI::App& map) {
  add_missing(map, "label", "Labels of places");
  add_missing(map, "plan", "Floor plan of a map");
  add_missing(map, "street", "Street map of a map");
}

void add_eval_scene_commands(CLI::App& eval) { add_missing(eval, "labels", "Labels of images"); }

std::string config_of_flight(const ConfigArguments&) {
  throw ArgumentError(std::string("--of flight: ") + kWithout);
}

FloorPlanner floor_planner() { return {}; }

json image_content(const StoredMap&, const Explanation&) { return {{"unknown", kWithout}}; }

json add_floor_plan(const RunArguments&, const RunOptions&, const Dataset&, RunResult&) {
  warn(std::string("no floor plan: ") + kWithout);
  return {{"outcome", to_string(Outcome::Code::kNotAttempted)}, {"reason", kWithout}};
}

void check_street_models(const RunOptions&) {}

json add_street_map(const RunArguments&, const RunOptions&, const Dataset&, const RunResult&) {
  warn(std::string("no street map: ") + kWithout);
  return {{"outcome", to_string(Outcome::Code::kNotAttempted)}, {"reason", kWithout}};
}

}  // namespace placegraph::apps
