#pragma once
#include <placegraph/graph/measurements/marker_layout.h>
#include <placegraph/pipeline/flight/marker_map.h>

#include <nlohmann/json_fwd.hpp>

namespace placegraph::apps {

/// Mapped markers, their covariance, and their errors against `truth` where it has them.
nlohmann::json describe_marker_map(const MarkerMap& map, const MarkerLayout& known,
                                   const MarkerLayout& truth);

/// The layout `known`, with unplaced markers at their mapped poses.
MarkerLayout with_mapped(const MarkerLayout& known, const MarkerMap& map);

/// One line for people.
std::string marker_map_line(const nlohmann::json& described);

}  // namespace placegraph::apps
