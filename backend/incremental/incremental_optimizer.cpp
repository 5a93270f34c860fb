#include <placegraph/backend/incremental/incremental_engine.h>
#include <placegraph/backend/incremental/incremental_optimizer.h>
#include <placegraph/backend/linear/blas_threads.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <unordered_set>

namespace placegraph {
namespace {

/// The new part of the graph, with the earlier nodes that it is connected to.
PoseGraph neighbourhood(const IncrementalEngine* engine, const std::vector<PoseNode>& nodes,
                        const std::vector<Constraint>& constraints) {
  PoseGraph graph;
  graph.nodes = nodes;
  graph.constraints = constraints;
  if (!engine) return graph;
  std::unordered_set<int> seen;
  const auto add_known = [&](NodeId id) {
    const int node = engine->find(id);
    if (node >= 0 && seen.insert(node).second)
      graph.nodes.push_back({id, engine->pose(node), false});
  };
  for (const PoseNode& node : nodes) add_known(node.id);  // a repeated node, which check() rejects
  for (const Constraint& constraint : constraints) {
    if (const auto* relative = std::get_if<RelativePoseConstraint>(&constraint)) {
      add_known(relative->from);
      add_known(relative->to);
    } else {
      add_known(std::get<PositionConstraint>(constraint).node);
    }
  }
  if (!graph.nodes.empty() && kind_of(graph.nodes.front().T_world_node) != engine->kind())
    throw ArgumentError("pose graph: node " + to_string(graph.nodes.front().id) +
                        ": its kind differs from that of the first node");
  return graph;
}

bool same_nodes(const Constraint& a, const Constraint& b) {
  if (a.index() != b.index()) return false;
  if (const auto* relative = std::get_if<RelativePoseConstraint>(&a)) {
    const auto& other = std::get<RelativePoseConstraint>(b);
    return relative->from == other.from && relative->to == other.to;
  }
  return std::get<PositionConstraint>(a).node == std::get<PositionConstraint>(b).node;
}

void check(const IncrementalEngine* engine, const GraphChange& change) {
  std::vector<Constraint> measured = change.constraints;
  const auto check_number = [&](int constraint, const std::string& subject) {
    if (!engine || constraint < 0 || constraint >= engine->constraints())
      throw ArgumentError(subject + ": unknown constraint");
  };
  for (const ConstraintRevision& revision : change.revised) {
    const std::string subject =
        "incremental optimizer: revision of constraint " + std::to_string(revision.constraint);
    check_number(revision.constraint, subject);
    if (!same_nodes(engine->constraint(revision.constraint), revision.measured))
      throw ArgumentError(subject + ": it connects other nodes");
    measured.push_back(revision.measured);
  }
  for (const ConstraintWeight& w : change.weights) {
    const std::string subject =
        "incremental optimizer: weight of constraint " + std::to_string(w.constraint);
    check_number(w.constraint, subject);
    if (!(w.weight >= 0 && std::isfinite(w.weight)))
      throw ArgumentError(subject + ": negative or not finite");
  }
  neighbourhood(engine, change.nodes, measured).check();
}

}  // namespace

IncrementalOptimizer::IncrementalOptimizer(const IncrementalOptions& options) : options_(options) {
  options_.check();
  use_one_blas_thread();
}
IncrementalOptimizer::~IncrementalOptimizer() = default;
IncrementalOptimizer::IncrementalOptimizer(IncrementalOptimizer&&) noexcept = default;
IncrementalOptimizer& IncrementalOptimizer::operator=(IncrementalOptimizer&&) noexcept = default;

IncrementalOptimizer::IncrementalOptimizer(const IncrementalOptions& options,
                                           const PoseGraph& graph)
    : IncrementalOptimizer(options) {
  graph.check();
  if (graph.nodes.empty()) return;
  engine_ = IncrementalEngine::make(kind_of(graph.nodes.front().T_world_node), options_);
  for (const PoseNode& node : graph.nodes) engine_->add_node(node);
  engine_->add_constraints(graph.constraints, true);
}

IncrementalStep IncrementalOptimizer::apply(const GraphChange& change) {
  check(engine_.get(), change);
  IncrementalStep step;
  step.outcome = Outcome::ok();
  step.cost = cost();
  if (!engine_ && change.nodes.empty()) return step;
  if (!engine_)
    engine_ = IncrementalEngine::make(kind_of(change.nodes.front().T_world_node), options_);
  step.first_constraint = engine_->constraints();
  for (const PoseNode& node : change.nodes) engine_->add_node(node);
  engine_->add_constraints(change.constraints, false);
  for (const ConstraintRevision& revision : change.revised) engine_->revise(revision);
  engine_->set_weights(change.weights);
  engine_->optimize(options_.excess, step);
  return step;
}

IncrementalStep IncrementalOptimizer::finish() {
  IncrementalStep step;
  step.outcome = Outcome::ok();
  if (!engine_) return step;
  step.first_constraint = engine_->constraints();
  engine_->optimize(options_.final_excess, step);
  return step;
}

std::optional<PoseKind> IncrementalOptimizer::kind() const {
  if (!engine_) return std::nullopt;
  return engine_->kind();
}

std::optional<Pose> IncrementalOptimizer::pose(NodeId node_id) const {
  const int node = engine_ ? engine_->find(node_id) : -1;
  if (node < 0) return std::nullopt;
  return engine_->pose(node);
}

PoseGraph IncrementalOptimizer::graph() const { return engine_ ? engine_->graph() : PoseGraph(); }

int IncrementalOptimizer::constraints() const { return engine_ ? engine_->constraints() : 0; }

const Constraint& IncrementalOptimizer::constraint(int number) const {
  require(number >= 0 && number < constraints(), "incremental optimizer: unknown constraint");
  return engine_->constraint(number);
}

double IncrementalOptimizer::cost() const { return engine_ ? engine_->cost() : 0; }

Eigen::MatrixXd IncrementalOptimizer::covariance(const std::vector<NodeId>& node_ids) const {
  std::vector<int> nodes;
  for (const NodeId id : node_ids) {
    nodes.push_back(engine_ ? engine_->find(id) : -1);
    if (nodes.back() < 0)
      throw ArgumentError("incremental optimizer: covariance of unknown node " + to_string(id));
  }
  return engine_ ? engine_->covariance(nodes) : Eigen::MatrixXd();
}

Information IncrementalOptimizer::relative_covariance(NodeId from, NodeId to) const {
  const int a = engine_ ? engine_->find(from) : -1, b = engine_ ? engine_->find(to) : -1;
  for (const auto& [id, node] : {std::pair(from, a), std::pair(to, b)})
    if (node < 0)
      throw ArgumentError("incremental optimizer: covariance of unknown node " + to_string(id));
  return engine_->relative_covariance(a, b);
}

}  // namespace placegraph
