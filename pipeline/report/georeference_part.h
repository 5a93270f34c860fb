#pragma once
#include <placegraph/graph/map.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace placegraph::report {

/// The folder that `placegraph map georeference` wrote for a run: the run's own, or `georeference`
/// in it; empty where there is none.
std::string georeference_of(const std::string& folder);

/// Latitude, longitude and height of every frame of a map, and how well the fixes agree.
/// Throws FileError if the folder has no georeference, or one of another map.
nlohmann::json describe_georeference(const std::string& folder, const Map& map);

}  // namespace placegraph::report
