#pragma once
#include <placegraph/graph/place_graph.h>
#include <placegraph/graph/place_transitions.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Writes the topological map as GraphML, which networkx, igraph, Gephi and yEd read.
///
/// The graph has a node per place, a directed edge per transition with its count, and an undirected
/// edge per loop closure between places. Node attributes: x, y, z [map's unit], qx, qy, qz, qw
/// (T_map_place), component, views (number of keyframes), labels (separated by commas). Edge
/// attributes: kind ("transition" or "loop"), count, length [map's unit].
std::string to_graphml(const PlaceGraph& graph, const std::vector<PlaceTransition>& transitions);

/// Writes the topological map for Graphviz; `neato -n` keeps the positions of the places.
///
/// Places are seen from above, x to the right and z up. Transitions in both directions are one edge
/// with two arrowheads, loops are dashed.
std::string to_dot(const PlaceGraph& graph, const std::vector<PlaceTransition>& transitions);

}  // namespace placegraph
