#include "apps/map/map_semantic.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/datasets/open_dataset.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/results/map_file.h"
#include "apps/results/semantic_map_files.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

struct MapSemanticArguments {
  std::string map, out, georeference;
  std::vector<std::string> settings;
  UrbanModelPaths models;
  bool as_json = false, force = false;
};

void write_map_of_street(const MapSemanticArguments& a) {
  UrbanMapperOptions options;
  for (const std::string& setting : a.settings) set_option(options, setting);
  options.check();
  require_free_folder(a.out, a.force);
  check_urban_models(options, a.models);
  const StoredMap stored = read_stored_map(a.map);
  if (!stored.origin.calibration || stored.map.keyframes.empty())
    throw NoAnswer(a.map + ": nothing in it has a pose");
  std::optional<Georeference> earth;
  if (!a.georeference.empty()) earth = read_georeference(a.georeference, stored.map);
  const auto dataset = open_dataset(stored.origin.sequence);
  const UrbanMapper mapper =
      urban_mapper_of(stored.map, *stored.origin.calibration, *dataset, stored.origin.sensor,
                      stored.origin.lens_k1, options, a.models);
  const KeyframePoses poses = earth ? earth->T_enu_keyframe : poses_of(stored.map);
  const SemanticMap semantic =
      earth ? mapper.fuse(poses, -Eigen::Vector3d::UnitZ()) : mapper.fuse(stored.map);
  if (!semantic.outcome) throw NoAnswer(a.map + ": no semantic map: " + semantic.outcome.reason);
  const OutputFolder folder(a.out);
  write_semantic_map(a.out, semantic, mapper, stored.map, poses, dataset->name(),
                     earth ? std::optional(earth->origin) : std::nullopt);
  nlohmann::json summary = {
      {"keyframes", mapper.sights().size()},
      {"cells", std::count_if(semantic.cells.begin(), semantic.cells.end(),
                              [](const SemanticCell& cell) { return cell.label >= 0; })}};
  if (!earth)  // true scenes are not on the earth
    summary = describe_semantic_map(semantic, mapper, stored.map, *dataset, stored.origin.sequence);
  if (a.as_json)
    fmt::print("{}\n", summary.dump(1));
  else
    fmt::print("{}: {} cells of {} keyframes; results in {}\n", a.map,
               summary["cells"].get<std::int64_t>(), summary["keyframes"].get<std::int64_t>(),
               a.out);
}

}  // namespace

void add_map_semantic_command(CLI::App& map) {
  auto arguments = std::make_shared<MapSemanticArguments>();
  MapSemanticArguments& a = *arguments;
  CLI::App* command = map.add_subcommand("semantic", "What is where in the streets of a map.");
  command->footer("placegraph map semantic out/town --out out/town-semantic");
  command->add_option("MAP", a.map, "map.db, or the folder of placegraph run with it")->required();
  command->add_option("--out", a.out, "folder for semantic_map.ply, .json and .png")->required();
  command->add_option("--georeference", a.georeference,
                      "folder of placegraph georeference: the map is laid out east and north, and "
                      "semantic_map.geojson written");
  command->add_option("--model", a.models.urban, "another model of a street's classes");
  command->add_option("--surfaces-model", a.models.surfaces, "another model of surfaces");
  command->add_option("--set", a.settings, "one option of the map, key=value; may be repeated")
      ->allow_extra_args(false);
  command->add_flag("--json", a.as_json, "for machines");
  command->add_flag("--force", a.force, "write into a folder that is not empty");
  command->callback([arguments] { write_map_of_street(*arguments); });
}

}  // namespace placegraph::apps
