#pragma once
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace placegraph::apps {

struct MapPlanArguments {
  std::string map, out;               ///< map.db or its folder; folder for the results
  std::vector<std::string> settings;  ///< options of the floor plan, "key=value"
  bool force = false;                 ///< write into a folder that is not empty
};

struct MapPlanResult {
  std::string map, out;
  std::size_t walls = 0, doors = 0, rooms = 0;
  nlohmann::json summary;  ///< as in result.json of a run with a floor plan
};

/// Draws the floor plan of an indoor map: `placegraph map plan`.
/// Throws ArgumentError, FileError, and NoResult if there is no plan; then nothing is written.
MapPlanResult map_plan(const MapPlanArguments& arguments);

/// One line.
std::string to_text(const MapPlanResult& result);
std::string to_json(const MapPlanResult& result);

}  // namespace placegraph::apps
