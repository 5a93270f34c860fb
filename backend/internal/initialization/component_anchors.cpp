#include <placegraph/backend/internal/initialization/component_anchors.h>
#include <placegraph/graph/internal/core/disjoint_sets.h>

namespace placegraph {

template <class Group>
ComponentAnchors find_anchors(const PackedGraph<Group>& graph) {
  const int nodes = static_cast<int>(graph.poses.size());
  DisjointSets sets(graph.poses.size());
  for (const auto& edge : graph.edges)
    if (edge.weight != 0) sets.join(edge.from, edge.to);
  ComponentAnchors anchors;
  anchors.component = sets.numbers();
  anchors.anchor = graph.held;
  for (int i = 0; i < nodes; ++i)
    if (sets.root(i) == i) anchors.roots.push_back(i);
  anchors.components = static_cast<int>(anchors.roots.size());
  std::vector<char> constrained(anchors.roots.size(), false);
  for (int i = 0; i < nodes; ++i)
    if (graph.held[i]) constrained[anchors.component[i]] = true;
  anchors.floating.assign(anchors.components, false);
  for (const auto& position : graph.positions) {
    const int component = anchors.component[position.node];
    if (position.weight > 0 && !constrained[component]) anchors.floating[component] = true;
  }
  for (const int i : anchors.roots)
    if (!constrained[anchors.component[i]]) anchors.anchor[i] = true;
  return anchors;
}

template ComponentAnchors find_anchors(const PackedGraph<SE2>&);
template ComponentAnchors find_anchors(const PackedGraph<SE3>&);
template ComponentAnchors find_anchors(const PackedGraph<Sim3>&);

}  // namespace placegraph
