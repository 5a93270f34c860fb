#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/results/street_mapper.h"

namespace placegraph::apps {

struct MapStreetArguments {
  std::string map, out;      ///< map.db or its folder; folder for the results
  std::string georeference;  ///< folder written by `placegraph map georeference`; empty: none
  std::vector<std::string> settings;  ///< options of the street map, "key=value"
  StreetMapModelPaths models;
  bool force = false;  ///< write into a folder that is not empty
};

struct MapStreetResult {
  std::string map, out;
  nlohmann::json summary;  ///< as in result.json of a run with a street map
};

/// Makes the street map of a saved map: `placegraph map street`.
/// Throws ArgumentError, FileError, and NoResult if there is none; then nothing is written.
MapStreetResult map_street(const MapStreetArguments& arguments);

/// One line.
std::string to_text(const MapStreetResult& result);
std::string to_json(const MapStreetResult& result);

}  // namespace placegraph::apps
