#pragma once
#include <placegraph/graph/map.h>

#include <nlohmann/json_fwd.hpp>

namespace placegraph {

/// The components for result.json: number, main, posed, first_frame, last_frame, and the file of
/// the trajectory.
nlohmann::json describe_components(const Map& map);

}  // namespace placegraph
