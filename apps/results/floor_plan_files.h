#pragma once
#include <placegraph/graph/map.h>
#include <placegraph/graph/scene/indoor_map.h>

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace placegraph {
class Dataset;
}

namespace placegraph::apps {

/// Writes floor_plan.json, floor_plan.svg and floor_plan.png into a folder.
void write_floor_plan(const std::string& folder, const IndoorMap& plan, const Map& map,
                      const std::string& title);

/// Length of the observed walls over that of the outlines of all rooms, at most 1; 0 without rooms.
double walled_share(const IndoorMap& plan);

/// A warning if most of the outlines of the rooms are not walls that were observed.
std::optional<std::string> doubt_of(const IndoorMap& plan);

/// Members of result.json for a floor plan.
/// These are counts and, if the sequence's folder has the true plan (floorplan.json) and true
/// poses, its errors: by the first pose ("origin") and after the alignment of the trajectory
/// ("se3").
nlohmann::json describe_floor_plan(const IndoorMap& plan, const Map& map, const Dataset& dataset,
                                   const std::string& sequence);

/// Writes the labels of the places into a saved map.
void save_labels(const std::string& map_file, const PlaceGraph& places);

}  // namespace placegraph::apps
