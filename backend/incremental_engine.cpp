#include <placegraph/backend/incremental_engine.h>
#include <placegraph/backend/local_solver.h>
#include <placegraph/backend/relative_covariance.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace placegraph {
namespace {

/// Steps go down the tree to where a node's share of the cost is below this part of what is
/// allowed.
constexpr double kThresholdShare = 0.005;
/// An iteration that leaves more than this part of the predicted excess is slow: the model is off.
constexpr double kSlow = 0.25;
/// Edges whose Jacobians have changed by this share are then linearized anew, a tenth of that at
/// the next time, and so on. A long chain bends far by little in each of its edges.
constexpr double kFirstChange = 3e-4, kLastChange = 1e-8;
/// Iterations begin at a part of the excess that is allowed, so that they seldom end above it and
/// few steps need a second one: lowered by every step that does, raised by every one that does not.
constexpr double kLeastBegin = 0.4, kLowerBegin = 0.6, kRaiseBegin = 1.02;
/// Costs below are rounding.
constexpr double kNoCost = 1e-12;
/// Of the tree, as a share of the diagonal: keeps open directions solvable.
constexpr double kDamping = 1e-10;
constexpr int kMostPatience = 64;
constexpr const char* kIndefinite = "the normal equations are indefinite at any damping";

/// A place in the list that is free, else a new one at its end.
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
IncrementalEngine<Group>::IncrementalEngine(const IncrementalOptions& options) : options_(options) {
  tree_.set_damping(kDamping);
}

template <class Group>
int IncrementalEngine<Group>::find(std::int64_t node_id) const {
  const auto found = index_.find(node_id);
  return found == index_.end() ? -1 : found->second;
}

// What the graph is made of.

template <class Group>
void IncrementalEngine<Group>::add_node(const PoseNode& node) {
  index_.emplace(node.id, static_cast<int>(nodes_.size()));
  ids_.push_back(node.id);
  fixed_.push_back(node.fixed);
  const auto& T_world_node = std::get<Group>(node.T_world_node);
  nodes_.push_back({T_world_node, T_world_node, {}, {}});
  components_.add_node(node.fixed);
  tree_.add_variable();
}

template <class Group>
void IncrementalEngine<Group>::add_constraints(const std::vector<Constraint>& constraints,
                                               bool poses_hold) {
  // Odometry first, and nothing depends on the order in which the rest is given.
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
void IncrementalEngine<Group>::attach(int number, double weight) {
  if (const auto* relative = std::get_if<RelativePoseConstraint>(&constraints_[number]))
    add_edge(*relative, number, weight);
  else
    add_position(std::get<PositionConstraint>(constraints_[number]), number, weight);
}

/// Takes a constraint out of everything but the list of constraints: dead ones cost neither time
/// nor memory beside their record.
template <class Group>
void IncrementalEngine<Group>::detach(int number) {
  const int place = std::exchange(place_[number], -1);
  const auto mark = [&](int node) {
    if (!std::exchange(nodes_[node].gradient_stale, true)) gradient_stale_.push_back(node);
  };
  if (std::holds_alternative<PositionConstraint>(constraints_[number])) {
    Position& position = positions_[place];
    const int node = position.position.node;
    components_.anchor(node, -1);
    std::erase(nodes_[node].positions, place);
    tree_.remove_term(position.term);
    mark(node);
    position = Position();
    free_positions_.push_back(place);
  } else {
    Edge& edge = edges_[place];
    const int from = edge.edge.from, to = edge.edge.to;
    for (const int node : {from, to}) {
      std::erase(nodes_[node].edges, place);
      mark(node);
    }
    tree_.remove_term(edge.term);
    edge = Edge();
    edge_costs_[place] = 0;
    free_edges_.push_back(place);
    split(from, to);
  }
}

template <class Group>
void IncrementalEngine<Group>::add_edge(const RelativePoseConstraint& constraint, int number,
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
void IncrementalEngine<Group>::add_position(const PositionConstraint& constraint, int number,
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
void IncrementalEngine<Group>::revise(const ConstraintRevision& revision) {
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
void IncrementalEngine<Group>::set_weight(const ConstraintWeight& weight) {
  const int place = place_[weight.constraint];
  if (place < 0) {
    if (weight.weight > 0) attach(weight.constraint, weight.weight);
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
  apply_held();
}

template <class Group>
void IncrementalEngine<Group>::join(const Edge& edge) {
  const int from = edge.edge.from, to = edge.edge.to;
  if (components_.together(from, to)) return;
  const std::vector<int> moved = components_.join(from, to);
  if (moved.empty() || poses_hold_) return;
  const bool from_moves = std::find(moved.begin(), moved.end(), from) != moved.end();
  const Group &T_world_from = nodes_[from].T_world_node, &T_world_to = nodes_[to].T_world_node;
  const Group T_new_old = from_moves
                              ? T_world_to * edge.edge.T_to_from * T_world_from.inverse()
                              : T_world_from * edge.edge.T_to_from.inverse() * T_world_to.inverse();
  // No edge of the component feels it; if it has just one node it is put there exactly.
  for (const int node : moved) nodes_[node].T_world_node = T_new_old * nodes_[node].T_world_node;
}

/// An edge of two nodes is gone: makes two components of one unless another way joins them.
template <class Group>
void IncrementalEngine<Group>::split(int from, int to) {
  std::vector<char> seen(nodes_.size(), false);
  std::vector<int> reached = {to};
  seen[to] = true;
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const int e : nodes_[reached[i]].edges) {
      const auto& other = edges_[e].edge;
      const int next = other.from == reached[i] ? other.to : other.from;
      if (next == from) return;
      if (seen[next]) continue;
      seen[next] = true;
      reached.push_back(next);
    }
  components_.split(reached);
}

template <class Group>
void IncrementalEngine<Group>::apply_held() {
  for (const int node : components_.take_changed()) tree_.set_active(node, !components_.held(node));
}

// Its terms at the present poses.

template <class Group>
void IncrementalEngine<Group>::evaluate(int e) {
  Edge& edge = edges_[e];
  const int from = edge.edge.from, to = edge.edge.to;
  edge.evaluate(nodes_[from].T_world_node, nodes_[to].T_world_node, options_.rotation_error);
  edge_costs_[e] = edge.cost;
  for (const int node : {from, to})
    if (!std::exchange(nodes_[node].gradient_stale, true)) gradient_stale_.push_back(node);
}

template <class Group>
void IncrementalEngine<Group>::linearize(int e) {
  Edge& edge = edges_[e];
  const auto blocks = edge.linearize(nodes_[edge.edge.from].T_world_node,
                                     nodes_[edge.edge.to].T_world_node, options_.rotation_error);
  tree_.set_information(edge.term, blocks.from_from, blocks.from_to, blocks.to_to);
}

template <class Group>
void IncrementalEngine<Group>::evaluate_position(int p) {
  Position& position = positions_[p];
  const int node = position.position.node;
  const auto H = position.evaluate(nodes_[node].T_world_node);
  tree_.set_information(position.term, H, H, H);
  if (!std::exchange(nodes_[node].gradient_stale, true)) gradient_stale_.push_back(node);
}

/// Edges and positions of the nodes, which have moved.
template <class Group>
void IncrementalEngine<Group>::evaluate_around(const std::vector<int>& nodes) {
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
void IncrementalEngine<Group>::set_gradients() {
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

/// Linearizes those of the edges anew whose Jacobians have changed by more than `change`.
template <class Group>
int IncrementalEngine<Group>::relinearize(const std::vector<int>& edges, double change) {
  int count = 0;
  for (const int e : edges) {
    if (edges_[e].change <= change) continue;
    linearize(e);
    ++count;
  }
  return count;
}

template <class Group>
int IncrementalEngine<Group>::relinearize_all(double change) {
  std::vector<int> all;
  for (std::size_t e = 0; e < edges_.size(); ++e)
    if (edges_[e].term >= 0) all.push_back(static_cast<int>(e));
  return relinearize(all, change);
}

template <class Group>
double IncrementalEngine<Group>::cost() const {
  double cost = 0;
  for (const double of_edge : edge_costs_) cost += of_edge;
  for (const Position& position : positions_) cost += position.cost;
  return cost;
}

// Iterations.

/// False if no damping makes the factor positive: what was added is not finite, or nearly so.
template <class Group>
bool IncrementalEngine<Group>::factorize(IncrementalStep& step) {
  const int nodes = static_cast<int>(nodes_.size());
  const double growth = static_cast<double>(nodes) / std::max(1, nodes_when_ordered_);
  if (growth > 1.2 && static_cast<double>(tree_.entries()) >
                          1.5 * growth * static_cast<double>(tree_.entries_when_ordered())) {
    tree_.reorder();
    nodes_when_ordered_ = nodes;
  }
  bool done = tree_.factorize();
  step.nodes_refactored += tree_.variables_refactored();
  for (double damping = 1e-8; !done && damping < 1e9; damping *= 100) {
    steps_damped_ = 0;
    tree_.set_damping(damping);
    done = tree_.factorize();
    step.nodes_refactored += tree_.variables_refactored();
  }
  return done;
}

/// Lowers a raised damping again after a while, longer every time it was of no avail: it costs
/// a factorization of everything.
template <class Group>
void IncrementalEngine<Group>::relax_damping() {
  if (tree_.damping() == kDamping) return;
  if (++steps_damped_ < patience_) return;
  tree_.set_damping(kDamping);
  patience_ = std::min(2 * patience_, kMostPatience);
}

/// Moves the nodes that matter. False, and nothing has moved, if the cost would not fall.
template <class Group>
bool IncrementalEngine<Group>::iterate(double threshold, IncrementalStep& step) {
  const std::vector<int>& moved = tree_.solve(threshold);
  const double cost_before = cost();
  ++step.iterations;
  step.nodes_moved = static_cast<int>(moved.size());
  for (const int node : moved) {
    Node& n = nodes_[node];
    n.T_before = n.T_world_node;
    n.T_world_node = n.T_world_node.plus(tree_.delta(node));
  }
  evaluate_around(moved);
  step.cost = cost();
  if (step.cost < cost_before) return true;
  for (const int node : moved) nodes_[node].T_world_node = nodes_[node].T_before;
  evaluate_around(moved);
  step.cost = cost();
  return false;
}

template <class Group>
void IncrementalEngine<Group>::optimize(double excess, IncrementalStep& step) {
  step.cost = cost();
  double share = kThresholdShare, change = kFirstChange;
  double before = std::numeric_limits<double>::infinity();
  relax_damping();
  while (true) {
    set_gradients();
    if (!factorize(step)) {
      step.outcome = Outcome::failure(Outcome::Code::kNotConverged, kIndefinite);
      return;
    }
    step.predicted_excess = tree_.model_decrease();
    const double allowed = excess * step.cost + kNoCost;
    if (step.predicted_excess <= (step.iterations == 0 ? begin_ : 1) * allowed) {
      if (step.iterations == 1) begin_ = std::min(1.0, kRaiseBegin * begin_);
      if (step.iterations > 1) begin_ = std::max(kLeastBegin, kLowerBegin * begin_);
      return;
    }
    if (step.iterations >= options_.max_iterations) break;
    const bool slow = step.predicted_excess > kSlow * before;
    before = std::numeric_limits<double>::infinity();
    if (!slow && iterate(share * allowed, step)) {
      before = step.predicted_excess;
      step.edges_relinearized += relinearize(visited_, options_.relinearization);
      continue;
    }
    // The model does not hold what it promised: bring it up to date, and take more nodes along.
    const int count = relinearize_all(change);
    step.edges_relinearized += count;
    if (!slow && count == 0 && change < kLastChange) break;
    change *= 0.1;
    share *= 0.1;
  }
  solve_from_scratch(step);
}

template <class Group>
PackedGraph<Group> IncrementalEngine<Group>::packed() const {
  PackedGraph<Group> graph;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    graph.poses.push_back(nodes_[n].T_world_node);
    graph.held.push_back(components_.held(static_cast<int>(n)));
  }
  for (std::size_t c = 0; c < constraints_.size(); ++c) {
    if (place_[c] < 0) continue;
    if (std::holds_alternative<RelativePoseConstraint>(constraints_[c]))
      graph.edges.push_back(edges_[place_[c]].edge);
    else
      graph.positions.push_back(positions_[place_[c]].position);
  }
  return graph;
}

template <class Group>
void IncrementalEngine<Group>::solve_from_scratch(IncrementalStep& step) {
  step.solved_from_scratch = true;
  PackedGraph<Group> graph = packed();
  LocalSolverOptions options;
  options.rotation_error = options_.rotation_error;
  const LocalSolution solution = LocalSolver<Group>(options).solve(graph);
  step.outcome = solution.outcome;
  step.iterations += solution.iterations;
  std::vector<int> all;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    nodes_[n].T_world_node = graph.poses[n];
    all.push_back(static_cast<int>(n));
  }
  evaluate_around(all);
  step.edges_relinearized += relinearize(visited_, 0);
  set_gradients();
  step.cost = cost();
  if (factorize(step))
    step.predicted_excess = tree_.model_decrease();
  else
    step.outcome = Outcome::failure(Outcome::Code::kNotConverged, kIndefinite);
}

// What it tells.

template <class Group>
PoseGraph IncrementalEngine<Group>::graph() const {
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

template <class Group>
Eigen::MatrixXd IncrementalEngine<Group>::covariance(const std::vector<int>& nodes) const {
  constexpr int dof = Group::kDof;
  std::vector<int> active, place;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!tree_.active(nodes[i])) continue;
    active.push_back(nodes[i]);
    place.push_back(static_cast<int>(i));
  }
  const int size = static_cast<int>(nodes.size()) * dof;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(size, size);
  if (active.empty()) return covariance;
  const Eigen::MatrixXd of_active = tree_.covariance(active);
  for (std::size_t i = 0; i < active.size(); ++i)
    for (std::size_t j = 0; j < active.size(); ++j)
      covariance.template block<dof, dof>(place[i] * dof, place[j] * dof) =
          of_active.template block<dof, dof>(i * dof, j * dof);
  return covariance;
}

template <class Group>
Information IncrementalEngine<Group>::relative_covariance(int from, int to) const {
  require(components_.together(from, to), "incremental optimizer: nothing joins nodes " +
                                              std::to_string(ids_[from]) + " and " +
                                              std::to_string(ids_[to]));
  constexpr int dof = Group::kDof;
  const Eigen::MatrixXd joint = covariance({from, to});
  const Group T_to_from = nodes_[to].T_world_node.inverse() * nodes_[from].T_world_node;
  return placegraph::relative_covariance(T_to_from.adjoint(), joint.topLeftCorner(dof, dof),
                                         joint.bottomRightCorner(dof, dof),
                                         joint.topRightCorner(dof, dof));
}

template class IncrementalEngine<SE2>;
template class IncrementalEngine<SE3>;
template class IncrementalEngine<Sim3>;

std::unique_ptr<IncrementalOptimizer::Engine> IncrementalOptimizer::Engine::make(
    PoseKind kind, const IncrementalOptions& options) {
  switch (kind) {
    case PoseKind::kSE2:
      return std::make_unique<IncrementalEngine<SE2>>(options);
    case PoseKind::kSE3:
      return std::make_unique<IncrementalEngine<SE3>>(options);
    case PoseKind::kSim3:
      break;
  }
  return std::make_unique<IncrementalEngine<Sim3>>(options);
}

}  // namespace placegraph
