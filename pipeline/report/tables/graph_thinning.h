#pragma once
#include <cstddef>
#include <nlohmann/json_fwd.hpp>

namespace placegraph::report {

/// Joins places of a run with those before them until places and constraints have so few bytes.
void thin_places(nlohmann::json& run, std::size_t most_bytes);

/// Joins nodes of a graph with those before them until the graph has so few bytes.
/// Of edges of one kind between the same two nodes that with the largest chi2 stays.
void thin_graph(nlohmann::json& graph, std::size_t most_bytes);

}  // namespace placegraph::report
