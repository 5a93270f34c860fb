#include "apps/map/map_street.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/pipeline/map/map_file.h>
#include <placegraph/pipeline/results/georeference_reader.h>

#include <algorithm>
#include <optional>

#include "apps/support/output.h"

namespace placegraph::apps {

MapStreetResult map_street(const MapStreetArguments& a) {
  StreetMapperOptions options;
  for (const std::string& setting : a.settings) set_option(options, setting, option_notes());
  options.check();
  require_free_folder(a.out, a.force);
  check_street_map_models(options, a.models);
  const StoredMap stored = read_stored_map(a.map, messages());
  if (!stored.origin.calibration || stored.map.keyframes.empty())
    throw NoResult(a.map + ": nothing in it has a pose");
  std::optional<Georeference> earth;
  if (!a.georeference.empty()) earth = read_georeference(a.georeference, stored.map);
  const auto dataset = open_dataset(stored.origin.sequence);
  const StreetMapper mapper =
      street_mapper_of(stored.map, *stored.origin.calibration, *dataset, stored.origin.sensor,
                       stored.origin.lens_k1, options, a.models);
  const KeyframePoses poses = earth ? earth->T_enu_keyframe : poses_of(stored.map);
  const StreetMap semantic =
      earth ? mapper.fuse(poses, -Eigen::Vector3d::UnitZ()) : mapper.fuse(stored.map);
  if (!semantic.outcome) throw NoResult(a.map + ": no street map: " + semantic.outcome.reason);
  const OutputFolder folder(a.out);
  write_street_map(a.out, semantic, mapper, stored.map, poses, dataset->name(),
                   earth ? std::optional(earth->origin) : std::nullopt, messages());
  MapStreetResult result{a.map, a.out, {}};
  result.summary = {
      {"keyframes", mapper.observations().size()},
      {"cells", std::count_if(semantic.cells.begin(), semantic.cells.end(),
                              [](const StreetCell& cell) { return cell.label >= 0; })}};
  if (!earth)  // true scenes have no position on the earth
    result.summary = nlohmann::json::parse(
        street_map_json(semantic, mapper, stored.map, *dataset, stored.origin.sequence));
  return result;
}

std::string to_text(const MapStreetResult& result) {
  return fmt::format("{}: {} cells of {} keyframes; results in {}\n", result.map,
                     result.summary["cells"].get<std::int64_t>(),
                     result.summary["keyframes"].get<std::int64_t>(), result.out);
}

std::string to_json(const MapStreetResult& result) { return json_text(result.summary, 1); }

}  // namespace placegraph::apps
