// A node of the place graph looked up among its places.
#include <placegraph/graph/place_graph.h>

namespace placegraph {
bool wrong(const PlaceGraph& graph, NodeId node) { return graph.find(node) != nullptr; }
}  // namespace placegraph
