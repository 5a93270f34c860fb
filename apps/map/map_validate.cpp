#include "apps/map/map_validate.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/pipeline/map/map_file.h>
#include <placegraph/pipeline/places/history_check.h>

#include <nlohmann/json.hpp>
#include <set>

namespace placegraph::apps {
namespace {

/// Checks that keyframes and loops refer to frames of the map.
void require_frames(const std::string& path, const Map& map) {
  std::set<FrameId> frames;
  for (const FrameRecord& record : map.frames) frames.insert(record.frame);
  for (const Keyframe& keyframe : map.keyframes)
    if (!frames.count(keyframe.frame))
      throw FileError(path, fmt::format("table keyframe, row {}: frame {} is no frame of the map",
                                        keyframe.id.value(), keyframe.frame.value()));
  for (std::size_t i = 0; i < map.loops.size(); ++i)
    if (!frames.count(map.loops[i].query_frame) || !frames.count(map.loops[i].match_frame))
      throw FileError(
          path, fmt::format("table loop, row {}: frames {} and {} are not both of the "
                            "map",
                            i, map.loops[i].query_frame.value(), map.loops[i].match_frame.value()));
}

}  // namespace

MapValidateResult map_validate(const MapValidateArguments& arguments) {
  const std::string path = map_path_of(arguments.map);
  if (const std::string found = check_map_file(path); found != "ok")
    throw FileError(path, "is damaged: " + found);
  const StoredMap stored = read_map(path);
  const Map& map = stored.map;
  require_frames(path, map);
  (void)map.trajectory_optimized();
  if (!stored.history.keyframes.empty()) {
    try {
      check_history(map.place_graph.places, stored.history);
    } catch (const ArgumentError& error) {
      throw FileError(path, std::string("tables link, part, place: ") + error.what());
    }
  }
  check_map_checksums(path);
  return {path, stored.finished, map.place_graph.places.size(), map.frames.size()};
}

std::string to_text(const MapValidateResult& result) {
  return fmt::format("{}: valid, {}, {} places, {} frames\n", result.map,
                     result.finished ? "finished" : "broken off", result.places, result.frames);
}

std::string to_json(const MapValidateResult& result) {
  const nlohmann::json json = {{"valid", true},
                               {"finished", result.finished},
                               {"places", result.places},
                               {"frames", result.frames}};
  return json_text(json, 1);
}

}  // namespace placegraph::apps
