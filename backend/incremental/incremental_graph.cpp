#include <placegraph/backend/incremental/incremental_graph.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace placegraph {
namespace {

/// An unused place in the list, else a new one at its end.
template <class List>
int take_place(List& list, std::vector<int>& free) {
  if (free.empty()) {
    list.emplace_back();
    return static_cast<int>(list.size()) - 1;
  }
  const int place = free.back();
  free.pop_back();
  return place;
}

}  // namespace

template <class Group>
int IncrementalGraph<Group>::find(NodeId node_id) const {
  const auto found = index_.find(node_id);
  return found == index_.end() ? -1 : found->second;
}

template <class Group>
void IncrementalGraph<Group>::add_node(const PoseNode& node) {
  index_.emplace(node.id, static_cast<int>(nodes_.size()));
  ids_.push_back(node.id);
  fixed_.push_back(node.fixed);
  const auto& T_world_node = std::get<Group>(node.T_world_node);
  nodes_.push_back({T_world_node, T_world_node, {}, {}});
  components_.add_node(node.fixed);
  tree_.add_variable();
}

template <class Group>
void IncrementalGraph<Group>::add_constraints(const std::vector<Constraint>& constraints,
                                              bool poses_hold) {
  // Odometry first; the result does not depend on the order of the other constraints.
  std::vector<std::tuple<int, int, int, int>> order;
  const int first = static_cast<int>(constraints_.size());
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const int number = first + static_cast<int>(i);
    if (const auto* relative = std::get_if<RelativePoseConstraint>(&constraints[i]))
      order.emplace_back(relative->source != ConstraintSource::kOdometry, find(relative->from),
                         find(relative->to), number);
    else
      order.emplace_back(2, find(std::get<PositionConstraint>(constraints[i]).node), 0, number);
    constraints_.push_back(constraints[i]);
    place_.push_back(-1);
  }
  std::sort(order.begin(), order.end());
  poses_hold_ = poses_hold;
  for (const auto& entry : order) attach(std::get<3>(entry), 1);
  poses_hold_ = false;
  apply_held();
}

template <class Group>
void IncrementalGraph<Group>::attach(int number, double weight) {
  if (const auto* relative = std::get_if<RelativePoseConstraint>(&constraints_[number]))
    add_edge(*relative, number, weight);
  else
    add_position(std::get<PositionConstraint>(constraints_[number]), number, weight);
}

/// Removes a constraint from everything except the list of constraints.
/// Removed constraints cost no time, and no memory besides their record.
template <class Group>
void IncrementalGraph<Group>::detach(int number) {
  const int place = std::exchange(place_[number], -1);
  if (std::holds_alternative<PositionConstraint>(constraints_[number])) {
    Position& position = positions_[place];
    const int node = position.position.node;
    components_.anchor(node, -1);
    std::erase(nodes_[node].positions, place);
    tree_.remove_term(position.term);
    mark_gradient(node);
    position = Position();
    free_positions_.push_back(place);
  } else {
    Edge& edge = edges_[place];
    const int from = edge.edge.from, to = edge.edge.to;
    for (const int node : {from, to}) {
      std::erase(nodes_[node].edges, place);
      mark_gradient(node);
    }
    tree_.remove_term(edge.term);
    edge = Edge();
    edge_costs_[place] = 0;
    free_edges_.push_back(place);
    removed_.emplace_back(from, to);
  }
}

template <class Group>
void IncrementalGraph<Group>::add_edge(const RelativePoseConstraint& constraint, int number,
                                       double weight) {
  const int e = take_place(edges_, free_edges_);
  place_[number] = e;
  edge_costs_.resize(edges_.size());
  Edge& edge = edges_[e];
  edge.edge = {find(constraint.from),
               find(constraint.to),
               number,
               constraint.source == ConstraintSource::kOdometry,
               std::get<Group>(constraint.T_from_to).inverse(),
               constraint.information,
               constraint.kernel,
               weight};
  join(edge);
  nodes_[edge.edge.from].edges.push_back(e);
  nodes_[edge.edge.to].edges.push_back(e);
  edge.term = tree_.add_term(edge.edge.from, edge.edge.to);
  evaluate(e);
  linearize(e);
}

template <class Group>
void IncrementalGraph<Group>::add_position(const PositionConstraint& constraint, int number,
                                           double weight) {
  const int p = take_place(positions_, free_positions_);
  place_[number] = p;
  Position& position = positions_[p];
  position.position = {find(constraint.node),
                       number,
                       constraint.position_world,
                       constraint.lever_arm,
                       constraint.information,
                       constraint.kernel,
                       weight};
  components_.anchor(position.position.node, 1);
  nodes_[position.position.node].positions.push_back(p);
  position.term = tree_.add_term(position.position.node, -1);
  evaluate_position(p);
}

template <class Group>
void IncrementalGraph<Group>::revise(const ConstraintRevision& revision) {
  constraints_[revision.constraint] = revision.measured;
  const int place = place_[revision.constraint];
  if (place < 0) return;
  if (const auto* measured = std::get_if<PositionConstraint>(&revision.measured)) {
    auto& position = positions_[place].position;
    position.position_world = measured->position_world;
    position.lever_arm = measured->lever_arm;
    position.information = measured->information;
    position.kernel = measured->kernel;
    evaluate_position(place);
    return;
  }
  const auto& measured = std::get<RelativePoseConstraint>(revision.measured);
  auto& edge = edges_[place].edge;
  edge.odometry = measured.source == ConstraintSource::kOdometry;
  edge.T_to_from = std::get<Group>(measured.T_from_to).inverse();
  edge.information = measured.information;
  edge.kernel = measured.kernel;
  evaluate(place);
  linearize(place);
}

template <class Group>
void IncrementalGraph<Group>::set_weights(const std::vector<ConstraintWeight>& weights) {
  for (const ConstraintWeight& weight : weights) set_weight(weight);
  split_removed();
  apply_held();
}

template <class Group>
void IncrementalGraph<Group>::set_weight(const ConstraintWeight& weight) {
  const int place = place_[weight.constraint];
  if (place < 0) {
    if (weight.weight == 0) return;
    split_removed();  // what the constraint joins moves as a whole
    attach(weight.constraint, weight.weight);
  } else if (weight.weight == 0) {
    detach(weight.constraint);
  } else if (std::holds_alternative<PositionConstraint>(constraints_[weight.constraint])) {
    positions_[place].position.weight = weight.weight;
    evaluate_position(place);
  } else {
    edges_[place].edge.weight = weight.weight;
    evaluate(place);
    linearize(place);
  }
}

template <class Group>
void IncrementalGraph<Group>::join(const Edge& edge) {
  const int from = edge.edge.from, to = edge.edge.to;
  if (components_.together(from, to)) return;
  const std::vector<int> moved = components_.join(from, to);
  if (moved.empty() || poses_hold_) return;
  const bool from_moves = std::find(moved.begin(), moved.end(), from) != moved.end();
  const Group &T_world_from = nodes_[from].T_world_node, &T_world_to = nodes_[to].T_world_node;
  const Group T_new_old = from_moves
                              ? T_world_to * edge.edge.T_to_from * T_world_from.inverse()
                              : T_world_from * edge.edge.T_to_from.inverse() * T_world_to.inverse();
  // No edge of the component changes; a component of one node is set exactly.
  for (const int node : moved) nodes_[node].T_world_node = T_new_old * nodes_[node].T_world_node;
}

/// The nodes that edges connect with `start`, which become seen; none if `other` is among them.
template <class Group>
std::vector<int> IncrementalGraph<Group>::reached(int start, int other,
                                                  std::vector<char>& seen) const {
  std::vector<int> reached = {start};
  seen[start] = true;
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const int e : nodes_[reached[i]].edges) {
      const auto& edge = edges_[e].edge;
      const int next = edge.from == reached[i] ? edge.to : edge.from;
      if (next == other) return {};
      if (seen[next]) continue;
      seen[next] = true;
      reached.push_back(next);
    }
  return reached;
}

/// Splits the components that removed edges leave in pieces. For one edge the search ends where
/// another path connects its nodes; for several, it visits the nodes of their components once.
template <class Group>
void IncrementalGraph<Group>::split_removed() {
  if (removed_.empty()) return;
  std::vector<char> seen(nodes_.size(), false);
  std::vector<std::vector<int>> pieces;
  const bool one = removed_.size() == 1;
  for (const auto& [from, to] : removed_)
    for (const int node : {to, from}) {
      if (seen[node]) continue;
      pieces.push_back(reached(node, one ? from : -1, seen));
      if (one) break;
    }
  removed_.clear();
  if (!pieces.front().empty()) components_.split(pieces);
}

template <class Group>
void IncrementalGraph<Group>::apply_held() {
  for (const int node : components_.take_changed()) tree_.set_active(node, !components_.held(node));
}

// Its terms at the current poses.

template <class Group>
void IncrementalGraph<Group>::evaluate(int e) {
  Edge& edge = edges_[e];
  const int from = edge.edge.from, to = edge.edge.to;
  edge.evaluate(nodes_[from].T_world_node, nodes_[to].T_world_node, rotation_error_);
  edge_costs_[e] = edge.cost;
  for (const int node : {from, to}) mark_gradient(node);
}

template <class Group>
void IncrementalGraph<Group>::linearize(int e) {
  Edge& edge = edges_[e];
  const auto blocks = edge.linearize(nodes_[edge.edge.from].T_world_node,
                                     nodes_[edge.edge.to].T_world_node, rotation_error_);
  tree_.set_information(edge.term, blocks.from_from, blocks.from_to, blocks.to_to);
}

template <class Group>
void IncrementalGraph<Group>::evaluate_position(int p) {
  Position& position = positions_[p];
  const int node = position.position.node;
  const auto H = position.evaluate(nodes_[node].T_world_node);
  tree_.set_information(position.term, H, H, H);
  mark_gradient(node);
}

/// Edges and positions of the moved nodes.
template <class Group>
void IncrementalGraph<Group>::evaluate_around(const std::vector<int>& nodes) {
  visited_.clear();
  for (const int node : nodes) {
    for (const int e : nodes_[node].edges)
      if (!std::exchange(edges_[e].visited, true)) visited_.push_back(e);
    for (const int p : nodes_[node].positions) evaluate_position(p);
  }
  for (const int e : visited_) {
    edges_[e].visited = false;
    evaluate(e);
  }
}

template <class Group>
void IncrementalGraph<Group>::move(const std::vector<int>& nodes) {
  for (const int node : nodes) {
    Node& n = nodes_[node];
    n.T_before = n.T_world_node;
    n.T_world_node = n.T_world_node.plus(tree_.delta(node));
  }
  evaluate_around(nodes);
}

template <class Group>
void IncrementalGraph<Group>::move_back(const std::vector<int>& nodes) {
  for (const int node : nodes) nodes_[node].T_world_node = nodes_[node].T_before;
  evaluate_around(nodes);
}

template <class Group>
void IncrementalGraph<Group>::set_poses(const std::vector<Group>& T_world_nodes) {
  std::vector<int> all;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    nodes_[n].T_world_node = T_world_nodes[n];
    all.push_back(static_cast<int>(n));
  }
  evaluate_around(all);
}

template <class Group>
void IncrementalGraph<Group>::set_gradients() {
  for (const int node : gradient_stale_) {
    Tangent g = Tangent::Zero();
    for (const int e : nodes_[node].edges)
      g += edges_[e].edge.from == node ? edges_[e].g_from : edges_[e].g_to;
    for (const int p : nodes_[node].positions) g += positions_[p].g;
    tree_.set_gradient(node, g);
    nodes_[node].gradient_stale = false;
  }
  gradient_stale_.clear();
}

template <class Group>
int IncrementalGraph<Group>::relinearize(const std::vector<int>& edges, double change) {
  int count = 0;
  for (const int e : edges) {
    if (edges_[e].change <= change) continue;
    linearize(e);
    ++count;
  }
  return count;
}

template <class Group>
int IncrementalGraph<Group>::relinearize_all(double change) {
  std::vector<int> all;
  for (std::size_t e = 0; e < edges_.size(); ++e)
    if (edges_[e].term >= 0) all.push_back(static_cast<int>(e));
  return relinearize(all, change);
}

template <class Group>
double IncrementalGraph<Group>::cost() const {
  double cost = 0;
  for (const double of_edge : edge_costs_) cost += of_edge;
  for (const Position& position : positions_) cost += position.cost;
  return cost;
}

template <class Group>
PackedGraph<Group> IncrementalGraph<Group>::packed() const {
  PackedGraph<Group> graph;
  for (const auto& node : nodes_) graph.poses.push_back(node.T_world_node);
  for (std::size_t c = 0; c < constraints_.size(); ++c) {
    if (place_[c] < 0) continue;
    if (std::holds_alternative<RelativePoseConstraint>(constraints_[c]))
      graph.edges.push_back(edges_[place_[c]].edge);
    else
      graph.positions.push_back(positions_[place_[c]].position);
  }
  graph.components = find_components(graph, fixed_);
  return graph;
}

template <class Group>
PoseGraph IncrementalGraph<Group>::graph() const {
  PoseGraph graph;
  for (std::size_t n = 0; n < nodes_.size(); ++n)
    graph.nodes.push_back({ids_[n], nodes_[n].T_world_node, fixed_[n] != 0});
  for (std::size_t c = 0; c < constraints_.size(); ++c) {
    if (place_[c] < 0) continue;
    const bool relative = std::holds_alternative<RelativePoseConstraint>(constraints_[c]);
    const double weight =
        relative ? edges_[place_[c]].edge.weight : positions_[place_[c]].position.weight;
    graph.constraints.push_back(constraints_[c]);
    // weight rho(s; width) = rho(weight s; sqrt(weight) width) for every kernel.
    std::visit(
        [&](auto& constraint) {
          constraint.information *= weight;
          constraint.kernel.width *= std::sqrt(weight);
        },
        graph.constraints.back());
  }
  return graph;
}

template class IncrementalGraph<SE2>;
template class IncrementalGraph<SE3>;
template class IncrementalGraph<Sim3>;

}  // namespace placegraph
