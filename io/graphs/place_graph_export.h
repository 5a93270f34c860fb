#pragma once
#include <placegraph/graph/place_graph.h>
#include <placegraph/graph/place_transitions.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The topological map as other programs draw and search it: a node per place, a directed edge per
/// transition with how often it was made, and an undirected one per loop closure between places.
///
/// GraphML (graphml.graphdrawing.org), as networkx, igraph, Gephi and yEd read it. Node attributes:
/// x, y, z [map's unit], qx, qy, qz, qw (T_map_place), component, views, labels (comma between);
/// edge attributes: kind ("transition" or "loop"), count, length [map's unit].
std::string to_graphml(const PlaceGraph& graph, const std::vector<PlaceTransition>& transitions);

/// Graphviz: places where they lie seen from above (`neato -n` keeps them there), x to the right
/// and z up; transitions made both ways are one edge with two arrowheads, loops are dashed.
std::string to_dot(const PlaceGraph& graph, const std::vector<PlaceTransition>& transitions);

}  // namespace placegraph
