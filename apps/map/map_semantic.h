#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/results/street_mapper.h"

namespace placegraph::apps {

struct MapSemanticArguments {
  std::string map, out;      ///< map.db or its folder; folder for the results
  std::string georeference;  ///< folder written by `placegraph map georeference`; empty: none
  std::vector<std::string> settings;  ///< options of the semantic map, "key=value"
  UrbanModelPaths models;
  bool force = false;  ///< write into a folder that is not empty
};

struct MapSemanticResult {
  std::string map, out;
  nlohmann::json summary;  ///< as in result.json of a run with a semantic map
};

/// Makes the semantic map of the streets of a saved map: `placegraph map street`.
/// Throws ArgumentError, FileError, and NoResult if there is none; then nothing is written.
MapSemanticResult map_semantic(const MapSemanticArguments& arguments);

/// One line.
std::string to_text(const MapSemanticResult& result);
std::string to_json(const MapSemanticResult& result);

}  // namespace placegraph::apps
