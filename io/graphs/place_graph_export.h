#pragma once
#include <placegraph/graph/place_graph.h>
#include <placegraph/graph/place_transitions.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Writes the topological map as GraphML, which networkx, igraph, Gephi and yEd read.
///
/// A node per place, a directed edge per transition with how often it was made, and an undirected
/// one per loop closure between places. Node attributes: x, y, z [map's unit], qx, qy, qz, qw
/// (T_map_place), component, views (number of keyframes), labels (separated by commas). Edge
/// attributes: kind ("transition" or "loop"), count, length [map's unit].
std::string to_graphml(const PlaceGraph& graph, const std::vector<PlaceTransition>& transitions);

/// Writes the topological map for Graphviz; `neato -n` keeps the places where they are.
///
/// Places are seen from above, x to the right and z up. Transitions made both ways are one edge
/// with two arrowheads, loops are dashed.
std::string to_dot(const PlaceGraph& graph, const std::vector<PlaceTransition>& transitions);

}  // namespace placegraph
