#pragma once
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace placegraph::apps {

struct MapPlanArguments {
  std::string map, out;               ///< map.db or the folder with it; folder of the results
  std::vector<std::string> settings;  ///< "key=value", of the plan
  bool force = false;                 ///< write into a folder that is not empty
};

struct MapPlanResult {
  std::string map, out;
  std::size_t walls = 0, doors = 0, rooms = 0;
  nlohmann::json summary;  ///< as result.json says it of a run with a plan
};

/// `placegraph map plan`: draws the floor plan of an indoor map. Throws ArgumentError, FileError,
/// and NoAnswer where there is none; then nothing is written.
MapPlanResult map_plan(const MapPlanArguments& arguments);

/// One line.
std::string to_text(const MapPlanResult& result);
std::string to_json(const MapPlanResult& result);

}  // namespace placegraph::apps
