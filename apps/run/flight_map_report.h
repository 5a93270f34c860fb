#pragma once
#include <placegraph/graph/internal/measurements/marker_layout.h>
#include <placegraph/pipeline/internal/flight/marker_map.h>

#include <nlohmann/json_fwd.hpp>

namespace placegraph::apps {

/// The markers that were mapped, how sure they are, and how far from where `truth` has them (those
/// it has).
nlohmann::json describe_marker_map(const MarkerMap& map, const MarkerLayout& known,
                                   const MarkerLayout& truth);

/// What is known afterwards: `known`, its unplaced markers where they were mapped.
MarkerLayout with_mapped(const MarkerLayout& known, const MarkerMap& map);

/// One line for people.
std::string marker_map_line(const nlohmann::json& described);

}  // namespace placegraph::apps
