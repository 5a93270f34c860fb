#pragma once
#include <placegraph/graph/indoor_map.h>
#include <placegraph/graph/map.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace placegraph {
class Dataset;
}

namespace placegraph::apps {

/// Writes floor_plan.json, floor_plan.svg and floor_plan.png into a folder.
void write_floor_plan(const std::string& folder, const IndoorMap& plan, const Map& map,
                      const std::string& title);

/// What result.json says of a plan: counts, and, where the sequence's folder holds the true plan
/// (floorplan.json) and true poses, how far it is off, by the first pose ("origin") and after the
/// alignment of the trajectory ("se3").
nlohmann::json describe_floor_plan(const IndoorMap& plan, const Map& map, const Dataset& dataset,
                                   const std::string& sequence);

}  // namespace placegraph::apps
