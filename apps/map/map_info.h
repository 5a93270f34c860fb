#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace placegraph::apps {

struct MapInfoArguments {
  std::string map;      ///< map.db, or a folder written by `placegraph run`
  bool places = false;  ///< list the places too
};

struct MapInfoResult {
  /// Members file, schema, finished, sequence, sensor; numbers of places, keyframes, frames, ...;
  /// the path length (path_length); bytes of the file and of its largest tables. If the places are
  /// listed also place_list: id, component, frame of the anchor keyframe, number of keyframes,
  /// position in the map (null: images without a camera), labels.
  nlohmann::json summary;
};

/// Summarizes a saved map: `placegraph map info`.
/// Warns on stderr of a map whose run was broken off. Throws FileError.
MapInfoResult map_info(const MapInfoArguments& arguments);

/// Six lines, and one for each place that is listed.
std::string to_text(const MapInfoResult& result);
std::string to_json(const MapInfoResult& result);

}  // namespace placegraph::apps
