#pragma once
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/map.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace placegraph::apps {

/// Writes `trajectory_optimized.componentN.tum` and `.kitti` for every component but the main one,
/// whose files have no number. Removes files of an earlier run in this folder.
void write_other_components(const std::string& folder, const Map& map);

/// The components for result.json: number, main, posed, first_frame, last_frame, and the file of
/// the trajectory.
nlohmann::json describe_components(const Map& map);

/// One line about the components of a map that has several, else an empty text.
std::string components_text(const nlohmann::json& components);

}  // namespace placegraph::apps
