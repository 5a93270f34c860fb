#include <fmt/format.h>
#include <placegraph/backend/factor_graph/landmark_graph_optimizer.h>
#include <placegraph/backend/factors/point_in_node.h>
#include <placegraph/backend/factors/pose_prior.h>
#include <placegraph/backend/linear/whitening.h>
#include <placegraph/backend/pose_graph/pose_graph_doubts.h>
#include <placegraph/backend/solver/free_directions.h>
#include <placegraph/backend/solver/local_solver.h>
#include <placegraph/graph/core/disjoint_sets.h>
#include <placegraph/graph/pose_graph/node_index.h>

#include <algorithm>

namespace placegraph {
namespace {

/// Positions of the nodes and points of a landmark graph among the variables.
struct VariableIndex {
  NodeIndex nodes, points;
  int first_point = 0;

  explicit VariableIndex(const LandmarkGraph& graph)
      : nodes(graph.poses.index_by_id()), first_point(static_cast<int>(graph.poses.nodes.size())) {
    std::vector<NodeId> ids;
    for (const GraphPoint& point : graph.points) ids.push_back(point.id);
    points = NodeIndex(ids);
  }
  int node(NodeId id) const { return nodes.at(id); }
  int point(NodeId id) const { return first_point + points.at(id); }
};

/// The connected components of nodes and points.
DisjointSets connected(const LandmarkGraph& graph, const VariableIndex& index) {
  DisjointSets sets(graph.poses.nodes.size() + graph.points.size());
  for (const Constraint& constraint : graph.poses.constraints)
    if (const auto* edge = std::get_if<RelativePoseConstraint>(&constraint))
      sets.join(index.node(edge->from), index.node(edge->to));
  for (const PointObservation& observation : graph.observations)
    sets.join(index.node(observation.node), index.point(observation.point));
  return sets;
}

template <class Group>
void add_priors_and_observations(const LandmarkGraph& graph, const VariableIndex& index,
                                 RotationError rotation_error, FactorGraph& factors) {
  constexpr int dim = Group::kDof == 3 ? 2 : 3;
  for (const PosePriorConstraint& prior : graph.priors)
    factors.add(PosePriorFactor<Group>(std::get<Group>(prior.T_world_node),
                                       whitening<typename Group::Jacobian>(prior.information),
                                       rotation_error),
                {index.node(prior.node)});
  for (const PointObservation& observation : graph.observations)
    factors.add(PointInNodeFactor<Group>(observation.position_node,
                                         whitening<Eigen::Matrix<double, dim, dim>>(
                                             observation.information.topLeftCorner<dim, dim>())),
                {index.node(observation.node), index.point(observation.point)});
}

}  // namespace

FactorGraph to_factor_graph(const LandmarkGraph& graph, RotationError rotation_error) {
  graph.check();
  const VariableIndex index(graph);
  FactorGraph factors = to_factor_graph(graph.poses, rotation_error);
  for (const GraphPoint& point : graph.points) factors.add_variable(point.position_world);
  const std::vector<char> held = find_components(graph).held;
  for (std::size_t i = 0; i < factors.variables.size(); ++i) factors.variables[i].held = held[i];
  if (graph.poses.kind() == PoseKind::kSE2)
    add_priors_and_observations<SE2>(graph, index, rotation_error, factors);
  else if (graph.poses.kind() == PoseKind::kSE3)
    add_priors_and_observations<SE3>(graph, index, rotation_error, factors);
  return factors;
}

double chi2(const LandmarkGraph& graph, RotationError rotation_error) {
  double sum = 0;
  for (const auto& square : squared_residuals(to_factor_graph(graph, rotation_error)))
    sum += square.value_or(0);
  return sum;
}

int count_components(const LandmarkGraph& graph) {
  // Nodes are the first variables, so their components have the first numbers.
  const std::vector<int> numbers = connected(graph, VariableIndex(graph)).numbers();
  const auto nodes = static_cast<std::ptrdiff_t>(graph.poses.nodes.size());
  return nodes == 0 ? 0 : 1 + *std::max_element(numbers.begin(), numbers.begin() + nodes);
}

std::vector<int> held_for_want_of_a_tie(const LandmarkGraph& graph) {
  const std::vector<char> held = find_components(graph).held;
  std::vector<int> nodes;
  for (std::size_t i = 0; i < graph.poses.nodes.size(); ++i)
    if (held[i] && !graph.poses.nodes[i].fixed) nodes.push_back(static_cast<int>(i));
  return nodes;
}

namespace {

/// Optimizes with the normal equations of the pose graph; points are poses without rotation.
template <class Group>
LandmarkGraphReport solve_packed(LandmarkGraph graph, const LandmarkGraphOptions& options,
                                 const LogSink& log_sink) {
  constexpr int dim = Group::kDof == 3 ? 2 : 3;
  PackedGraph<Group> packed = pack<Group>(graph);
  LandmarkGraphReport report;
  const LocalSolution solution = LocalSolver<Group>({.engine = PoseGraphEngine::kNative,
                                                     .rotation_error = options.rotation_error,
                                                     .max_iterations = options.max_iterations,
                                                     .relative_decrease = options.relative_decrease,
                                                     .log = log_sink})
                                     .solve(packed);
  report.outcome = solution.outcome;
  report.iterations = solution.iterations;
  report.chi2_initial = solution.cost_initial;
  report.chi2_final = solution.cost_final;
  unpack(packed, graph.poses);
  const std::size_t nodes = graph.poses.nodes.size();
  for (std::size_t i = 0; i < graph.points.size(); ++i)
    if (!packed.components.held[nodes + i])
      graph.points[i].position_world.head<dim>() = packed.poses[nodes + i].translation();
  report.graph = std::move(graph);
  return report;
}

LandmarkGraphReport solve_factors(LandmarkGraph graph, const LandmarkGraphOptions& options,
                                  const LogSink& log_sink) {
  LandmarkGraphReport report;
  const FactorGraph factors = to_factor_graph(graph, options.rotation_error);
  const FactorGraphReport solved =
      optimize_factor_graph(factors, {options.max_iterations, options.relative_decrease}, log_sink);
  report.outcome = solved.outcome;
  report.iterations = solved.iterations;
  report.chi2_initial = 2 * solved.cost_initial;
  report.chi2_final = 2 * solved.cost_final;
  const std::size_t nodes = graph.poses.nodes.size();
  for (std::size_t i = 0; i < nodes; ++i)
    if (!solved.graph.variables[i].held)
      std::visit(
          [&](auto& pose) {
            pose = std::get<std::decay_t<decltype(pose)>>(solved.graph.variables[i].value);
          },
          graph.poses.nodes[i].T_world_node);
  for (std::size_t i = 0; i < graph.points.size(); ++i)
    graph.points[i].position_world =
        std::get<Eigen::Vector3d>(solved.graph.variables[nodes + i].value);
  report.graph = std::move(graph);
  return report;
}

}  // namespace

NodeId id_of(const LandmarkGraph& graph, int variable) {
  const auto i = static_cast<std::size_t>(variable), nodes = graph.poses.nodes.size();
  return i < nodes ? graph.poses.nodes[i].id : graph.points[i - nodes].id;
}

namespace {

std::vector<NodeId> ids_of(const LandmarkGraph& graph, const std::vector<int>& variables) {
  std::vector<NodeId> ids;
  for (const int variable : variables) ids.push_back(id_of(graph, variable));
  return ids;
}

void add_doubts(LandmarkGraphReport& report) {
  Chi2Fit fit{.chi2 = report.chi2_final, .degrees_of_freedom = report.degrees_of_freedom};
  if (doubt_of_chi2(fit) == DoubtKind::kChi2Below) fit.rounding = chi2_of_rounding(report.graph);
  if (const auto kind = doubt_of_chi2(fit))
    report.doubts.push_back(doubt_about_chi2(*kind, fit, "", ""));
  if (report.free.count > 0)
    report.doubts.push_back(not_unique(report.free.count, ids_of(report.graph, report.free.nodes)));
  const std::vector<int> held = held_for_want_of_a_tie(report.graph);
  const int components = count_components(report.graph);
  if (components > 1 && !held.empty())
    report.doubts.push_back(
        {DoubtKind::kHeldComponents,
         fmt::format("the graph falls into {} components, of which {} are constrained to the world "
                     "by no prior and no FIX: each keeps a vertex where it is ({})",
                     components, held.size(), some_ids(ids_of(report.graph, held)))});
}

}  // namespace

LandmarkGraphReport optimize_landmark_graph(LandmarkGraph graph,
                                            const LandmarkGraphOptions& options,
                                            const LogSink& log_sink) {
  graph.check();
  LandmarkGraphReport report;
  if (options.engine == PoseGraphEngine::kCeres || graph.poses.kind() == PoseKind::kSim3)
    report = solve_factors(std::move(graph), options, log_sink);
  else
    report = graph.poses.kind() == PoseKind::kSE2
                 ? solve_packed<SE2>(std::move(graph), options, log_sink)
                 : solve_packed<SE3>(std::move(graph), options, log_sink);
  report.degrees_of_freedom = find_components(report.graph).degrees_of_freedom;
  if (!report.outcome) return report;
  report.free = find_free_directions(report.graph, options.rotation_error);
  add_doubts(report);
  return report;
}

}  // namespace placegraph
