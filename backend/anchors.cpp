#include <placegraph/backend/anchors.h>

#include <numeric>

namespace placegraph {

template <class Group>
Anchors find_anchors(const PackedGraph<Group>& graph) {
  const int nodes = static_cast<int>(graph.poses.size());
  std::vector<int> parent(nodes);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int node) {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
  };
  for (const auto& edge : graph.edges) {
    if (edge.weight == 0) continue;
    const int a = root(edge.from), b = root(edge.to);
    parent[std::max(a, b)] = std::min(a, b);  // the root is the first node of its component
  }
  Anchors anchors;
  anchors.component.resize(nodes);
  anchors.anchor = graph.held;
  std::vector<char> tied;
  for (int i = 0; i < nodes; ++i) {
    if (root(i) == i) {
      anchors.component[i] = anchors.components++;
      anchors.roots.push_back(i);
      tied.push_back(false);
    } else {
      anchors.component[i] = anchors.component[root(i)];
    }
    if (graph.held[i]) tied[anchors.component[i]] = true;
  }
  anchors.floating.assign(anchors.components, false);
  for (const auto& position : graph.positions) {
    const int component = anchors.component[position.node];
    if (position.weight > 0 && !tied[component]) anchors.floating[component] = true;
  }
  for (const int i : anchors.roots)
    if (!tied[anchors.component[i]]) anchors.anchor[i] = true;
  return anchors;
}

template Anchors find_anchors(const PackedGraph<SE2>&);
template Anchors find_anchors(const PackedGraph<SE3>&);
template Anchors find_anchors(const PackedGraph<Sim3>&);

}  // namespace placegraph
