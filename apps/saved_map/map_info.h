#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace placegraph::apps {

struct MapInfoArguments {
  std::string map;  ///< map.db, or the folder of placegraph run with it
};

struct MapInfoResult {
  /// file, schema, finished, sequence, sensor; how many places, keyframes, frames, ... it has; the
  /// length of its way (path_length); bytes of the file and of its largest tables.
  nlohmann::json told;
};

/// `placegraph map info`: what a saved map holds. Warns on stderr of a map whose run was broken
/// off. Throws FileError.
MapInfoResult map_info(const MapInfoArguments& arguments);

/// Six lines.
std::string to_text(const MapInfoResult& result);
std::string to_json(const MapInfoResult& result);

}  // namespace placegraph::apps
