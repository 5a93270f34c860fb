#include <placegraph/backend/incremental/incremental_components.h>

#include <algorithm>
#include <map>
#include <utility>

namespace placegraph {

int IncrementalComponents::add_node(bool fixed) {
  const int node = static_cast<int>(nodes_.size());
  nodes_.push_back({static_cast<int>(components_.size()), fixed, true});
  components_.push_back({{node}, node, fixed ? 1 : 0, fixed ? -1 : node});
  return node;
}

void IncrementalComponents::set_held(int node, bool held) {
  if (nodes_[node].held == held) return;
  nodes_[node].held = held;
  changed_.push_back(node);
}

/// Holds the first node of a component without anchors, and frees it if the component has anchors.
void IncrementalComponents::settle(Component& component) {
  const int hold = component.anchors > 0 || component.nodes.empty() ? -1 : component.first;
  if (component.held == hold) return;
  if (component.held >= 0) set_held(component.held, nodes_[component.held].fixed);
  if (hold >= 0) set_held(hold, true);
  component.held = hold;
}

std::vector<int> IncrementalComponents::join(int a, int b) {
  int stays = nodes_[a].component, moves = nodes_[b].component;
  const auto before = [&](int x, int y) {
    const bool x_constrained = components_[x].anchors > 0,
               y_constrained = components_[y].anchors > 0;
    return x_constrained != y_constrained ? x_constrained
                                          : components_[x].first < components_[y].first;
  };
  if (before(moves, stays)) std::swap(stays, moves);
  std::vector<int> moved;
  if (components_[moves].anchors == 0) moved = components_[moves].nodes;

  // The larger component keeps its number.
  Component &x = components_[stays], &y = components_[moves];
  const bool swap = x.nodes.size() < y.nodes.size();
  Component &into = swap ? y : x, &from = swap ? x : y;
  const int first = std::min(x.first, y.first);
  if (from.held >= 0 && from.held != first) set_held(from.held, nodes_[from.held].fixed);
  if (into.held >= 0 && into.held != first) set_held(into.held, nodes_[into.held].fixed);
  into.held = std::max(into.held == first ? first : -1, from.held == first ? first : -1);
  into.first = first;
  into.anchors += from.anchors;
  for (const int node : from.nodes) nodes_[node].component = swap ? moves : stays;
  into.nodes.insert(into.nodes.end(), from.nodes.begin(), from.nodes.end());
  from = Component{{}, -1, 0, -1};
  free_components_.push_back(swap ? stays : moves);
  settle(into);
  return moved;
}

int IncrementalComponents::add_component(const std::vector<int>& nodes) {
  int created = static_cast<int>(components_.size());
  if (free_components_.empty()) {
    components_.emplace_back();
  } else {
    created = free_components_.back();
    free_components_.pop_back();
  }
  components_[created] = {nodes, nodes.front(), 0, -1};
  for (const int node : nodes) nodes_[node].component = created;
  return created;
}

/// Counts the anchors of its nodes, and finds the first node.
void IncrementalComponents::count(Component& component) {
  component.first = *std::min_element(component.nodes.begin(), component.nodes.end());
  component.anchors = 0;
  for (const int node : component.nodes)
    component.anchors += nodes_[node].positions + nodes_[node].fixed;
}

void IncrementalComponents::split(const std::vector<std::vector<int>>& pieces) {
  std::map<int, std::size_t> left;  // number of nodes of each component that falls apart
  std::vector<int> parts;
  for (const std::vector<int>& piece : pieces) {
    const int old = nodes_[piece.front()].component;
    auto& rest = left.try_emplace(old, components_[old].nodes.size()).first->second;
    if (piece.size() == rest) continue;  // the last piece keeps the component
    rest -= piece.size();
    parts.push_back(add_component(piece));
  }
  for (const auto& [old, rest] : left) {
    Component& component = components_[old];
    if (rest == component.nodes.size()) continue;
    std::erase_if(component.nodes, [&](int node) { return nodes_[node].component != old; });
    const int of_held = component.held >= 0 ? nodes_[component.held].component : old;
    if (of_held != old) components_[of_held].held = std::exchange(component.held, -1);
    parts.push_back(old);
  }
  for (const int part : parts) count(components_[part]);
  for (const int part : parts) settle(components_[part]);
}

void IncrementalComponents::anchor(int node, int count) {
  nodes_[node].positions += count;
  Component& component = components_[nodes_[node].component];
  component.anchors += count;
  settle(component);
}

std::vector<int> IncrementalComponents::take_changed() { return std::exchange(changed_, {}); }

}  // namespace placegraph
