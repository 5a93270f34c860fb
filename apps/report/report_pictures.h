#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace placegraph::apps {

/// Walls, doors and rooms of floor_plan.json in the folder of a run, as polylines in the plan;
/// an empty list where there is none. Throws FileError, ArgumentError for a file that is no plan.
nlohmann::json describe_floor_plan(const std::string& folder);

/// The SVG files in the folder of a run, by name; those of more than 4 MB are left out.
nlohmann::json describe_pictures(const std::string& folder);

}  // namespace placegraph::apps
