#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A connected component of a pose graph, as a graph of its own.
struct GraphPart {
  PoseGraph graph;                      ///< nodes and constraints in the order of the whole
  std::vector<int> nodes, constraints;  ///< their positions in the whole, ascending
};

/// Splits a graph into its connected components, in the order of PoseGraph::components.
/// Throws ArgumentError for a constraint on an unknown node.
std::vector<GraphPart> split_components(const PoseGraph& graph);

}  // namespace placegraph
