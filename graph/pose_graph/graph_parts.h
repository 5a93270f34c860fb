#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A connected component as a graph of its own, and where its nodes and constraints stand in the
/// whole.
struct GraphPart {
  PoseGraph graph;
  std::vector<int> nodes, constraints;
};

/// The components in the order of PoseGraph::components, each in the order of the whole. Throws
/// ArgumentError for a constraint on an unknown node.
std::vector<GraphPart> split_components(const PoseGraph& graph);

}  // namespace placegraph
