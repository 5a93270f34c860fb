#include <placegraph/backend/incremental/incremental_engine.h>
#include <placegraph/backend/linear/relative_covariance.h>
#include <placegraph/backend/solver/local_solver.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>

#include <algorithm>
#include <limits>

namespace placegraph {
namespace {

/// Steps descend the tree to nodes whose share of the cost is below this part of the allowed
/// excess.
constexpr double kThresholdShare = 0.005;
/// An iteration that leaves more than this part of the predicted excess is slow: the model is
/// inaccurate.
constexpr double kSlow = 0.25;
/// Then edges whose Jacobians have changed by this share are linearized again, with a tenth of it
/// the next time, and so on. A long chain bends far by small changes of each edge.
constexpr double kFirstChange = 3e-4, kLastChange = 1e-8;
/// Iterations start at a part of the allowed excess, so that they seldom end above it and few steps
/// need a second one. Steps with a second iteration lower this part, the others raise it.
constexpr double kLeastBegin = 0.4, kLowerBegin = 0.6, kRaiseBegin = 1.02;
/// Costs below this value are rounding.
constexpr double kNoCost = 1e-12;
/// Damping of the tree as a share of the diagonal; undetermined directions stay solvable.
constexpr double kDamping = 1e-10;
constexpr int kMostPatience = 64;
constexpr const char* kIndefinite = "the normal equations are indefinite with any damping";

}  // namespace

template <class Group>
IncrementalEngineOf<Group>::IncrementalEngineOf(const IncrementalOptions& options)
    : options_(options), graph_(options.rotation_error), tree_(graph_.tree()) {
  tree_.set_damping(kDamping);
}

/// False if the factor is indefinite with any damping: an addition is not finite or extremely
/// large.
template <class Group>
bool IncrementalEngineOf<Group>::factorize(IncrementalStep& step) {
  const int nodes = graph_.nodes();
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

/// Lowers a raised damping after some steps; every failure increases their number.
/// Each attempt costs a factorization of the whole graph.
template <class Group>
void IncrementalEngineOf<Group>::relax_damping() {
  if (tree_.damping() == kDamping) return;
  if (++steps_damped_ < patience_) return;
  tree_.set_damping(kDamping);
  patience_ = std::min(2 * patience_, kMostPatience);
}

/// Moves the nodes with significant steps; false, without a motion, if the cost would not fall.
template <class Group>
bool IncrementalEngineOf<Group>::iterate(double threshold, IncrementalStep& step) {
  const std::vector<int>& moved = tree_.solve(threshold);
  const double cost_before = graph_.cost();
  ++step.iterations;
  step.nodes_moved = static_cast<int>(moved.size());
  graph_.move(moved);
  step.cost = graph_.cost();
  if (step.cost < cost_before) return true;
  graph_.move_back(moved);
  step.cost = graph_.cost();
  return false;
}

template <class Group>
void IncrementalEngineOf<Group>::optimize(double excess, IncrementalStep& step) {
  step.cost = graph_.cost();
  double share = kThresholdShare, change = kFirstChange;
  double before = std::numeric_limits<double>::infinity();
  relax_damping();
  while (true) {
    check_interruption();
    graph_.set_gradients();
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
      step.edges_relinearized += graph_.relinearize(graph_.visited(), options_.relinearization);
      continue;
    }
    // The decrease was smaller than predicted: updates the model and moves more nodes.
    const int count = graph_.relinearize_all(change);
    step.edges_relinearized += count;
    if (!slow && count == 0 && change < kLastChange) break;
    change *= 0.1;
    share *= 0.1;
  }
  solve_from_scratch(step);
}

template <class Group>
void IncrementalEngineOf<Group>::solve_from_scratch(IncrementalStep& step) {
  step.solved_from_scratch = true;
  PackedGraph<Group> graph = graph_.packed();
  LocalSolverOptions options;
  options.rotation_error = options_.rotation_error;
  const LocalSolution solution = LocalSolver<Group>(options).solve(graph);
  step.outcome = solution.outcome;
  step.iterations += solution.iterations;
  graph_.set_poses(graph.poses);
  step.edges_relinearized += graph_.relinearize(graph_.visited(), 0);
  graph_.set_gradients();
  step.cost = graph_.cost();
  if (factorize(step))
    step.predicted_excess = tree_.model_decrease();
  else
    step.outcome = Outcome::failure(Outcome::Code::kNotConverged, kIndefinite);
}

template <class Group>
Eigen::MatrixXd IncrementalEngineOf<Group>::covariance(const std::vector<int>& nodes) const {
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
Information IncrementalEngineOf<Group>::relative_covariance(int from, int to) const {
  require(graph_.together(from, to), "incremental optimizer: no constraints connect nodes " +
                                         to_string(graph_.id(from)) + " and " +
                                         to_string(graph_.id(to)));
  constexpr int dof = Group::kDof;
  const Eigen::MatrixXd joint = covariance({from, to});
  const Group T_to_from = graph_.pose(to).inverse() * graph_.pose(from);
  return placegraph::relative_covariance(T_to_from.adjoint(), joint.topLeftCorner(dof, dof),
                                         joint.bottomRightCorner(dof, dof),
                                         joint.topRightCorner(dof, dof));
}

template class IncrementalEngineOf<SE2>;
template class IncrementalEngineOf<SE3>;
template class IncrementalEngineOf<Sim3>;

std::unique_ptr<IncrementalEngine> IncrementalEngine::make(PoseKind kind,
                                                           const IncrementalOptions& options) {
  switch (kind) {
    case PoseKind::kSE2:
      return std::make_unique<IncrementalEngineOf<SE2>>(options);
    case PoseKind::kSE3:
      return std::make_unique<IncrementalEngineOf<SE3>>(options);
    case PoseKind::kSim3:
      break;
  }
  return std::make_unique<IncrementalEngineOf<Sim3>>(options);
}

}  // namespace placegraph
