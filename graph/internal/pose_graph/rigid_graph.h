#pragma once
#include <placegraph/graph/pose_graph/pose_graph.h>

namespace placegraph {

/// A graph of similarities as one of poses in space, for programs that know no scale: nodes keep
/// rotation and position, and every measured translation is brought to the world's unit by the
/// scale that the graph gives its first node. Information on the scale is marginalized out, that on
/// the translation divided by the squared scale; measured positions stay as they are. Other graphs
/// come back as they are. Where the nodes are, the costs of the two differ by what the scales
/// contribute.
PoseGraph rigid_graph(const PoseGraph& graph);

}  // namespace placegraph
