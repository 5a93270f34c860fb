#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/results/semantic_map_files.h"

namespace placegraph::apps {

struct MapSemanticArguments {
  std::string map, out;      ///< map.db or the folder with it; folder of the results
  std::string georeference;  ///< folder of placegraph georeference; empty: not on the earth
  std::vector<std::string> settings;  ///< "key=value", of the semantic map
  UrbanModelPaths models;
  bool force = false;  ///< write into a folder that is not empty
};

struct MapSemanticResult {
  std::string map, out;
  nlohmann::json summary;  ///< as result.json says it of a run with a semantic map
};

/// `placegraph map semantic`: what is where in the streets of a map. Throws ArgumentError,
/// FileError, and NoAnswer where there is none; then nothing is written.
MapSemanticResult map_semantic(const MapSemanticArguments& arguments);

/// One line.
std::string to_text(const MapSemanticResult& result);
std::string to_json(const MapSemanticResult& result);

}  // namespace placegraph::apps
