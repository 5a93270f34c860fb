#include <placegraph/backend/pose_graph/initialization_selection.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/backend/pose_graph/robust_optimizer.h>
#include <placegraph/backend/solver/graph_components.h>
#include <placegraph/backend/solver/packed_free_directions.h>
#include <placegraph/graph/pose_graph/graph_parts.h>
#include <placegraph/graph/text/log_message.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace placegraph {
namespace {

/// e^T Omega e of every constraint, in the order of PoseGraph::constraints.
template <class Group>
std::vector<double> packed_chi2(const PackedGraph<Group>& graph, RotationError rotation_error) {
  std::vector<double> chi2(graph.edges.size() + graph.positions.size());
  const std::vector<double> edges = chi2_by_edge(graph, rotation_error);
  for (std::size_t i = 0; i < edges.size(); ++i) chi2[graph.edges[i].constraint] = edges[i];
  const std::vector<double> positions = chi2_by_position(graph);
  for (std::size_t i = 0; i < positions.size(); ++i)
    chi2[graph.positions[i].constraint] = positions[i];
  return chi2;
}

double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

/// The sum without the rejected edges.
double sum_of_kept(std::vector<double> chi2, const std::vector<RejectedEdge>& rejected) {
  for (const RejectedEdge& edge : rejected) chi2[edge.constraint] = 0;
  return sum(chi2);
}

/// The initialization of a robust method.
/// False loops corrupt initializations that use loops. Graduated non-convexity uses the odometry,
/// because it needs a good initialization even if the given poses are not.
PoseGraphInitialization robust_initialization(const PoseGraphOptions& options) {
  if (options.initialization != PoseGraphInitialization::kAuto) return options.initialization;
  return options.robust.method == RobustMethod::kGnc ? PoseGraphInitialization::kOdometry
                                                     : PoseGraphInitialization::kFile;
}

/// Passes messages on; with the message after some seconds of a plain descent whose cost is far
/// above its expectation it says, once, what to do about edges that contradict each other.
template <class Group>
LogSink with_advice(const LogSink& sink, const PackedGraph<Group>& graph,
                    const PoseGraphOptions& options) {
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kPatience(5);
  static constexpr double kMuch = 3;  // cost over its expectation, as of DoubtKind::kChi2Above
  if (!sink || options.robust.method != RobustMethod::kNone) return sink;
  return [&sink, &graph, &options, next = Clock::now() + kPatience](
             LogLevel level, const std::string& message) mutable {
    sink(level, message);
    if (Clock::now() < next) return;
    next += kPatience;
    const double cost = robust_cost(graph, options.rotation_error);
    const int expected = graph.components.degrees_of_freedom;
    if (!(cost > kMuch * std::max(1, expected))) return;
    next = Clock::time_point::max();
    log(sink, LogLevel::kWarning,
        "pose graph: after {} s chi2 is {:.1f} times what the information of the edges lets "
        "expect: edges contradict each other, and every start takes long; the robust method auto "
        "(--robust auto) leaves false loops out",
        kPatience.count(), cost / std::max(1, expected));
  };
}

/// Optimizes from the selected initialization, and fills the report's fields about it.
template <class Group>
void minimize(PackedGraph<Group>& graph, const LocalSolverOptions& local,
              const PoseGraphOptions& options, PoseGraphReport& report) {
  InitializedSolution found;
  if (options.robust.method == RobustMethod::kNone) {
    LocalSolverOptions advising = local;
    advising.log = with_advice(local.log, graph, options);
    LocalSolver<Group> solver(advising);
    found =
        solve_from_initialization(graph, options.initialization, options.rotation_error, solver);
  } else {
    found.used = robust_initialization(options);
    set_initialization(graph, found.used, options.rotation_error);
    RobustSolution robust = solve_robustly(
        graph, local, options.robust, options.initialization == PoseGraphInitialization::kAuto);
    found.solution = std::move(robust.local);
    found.refined_from_certified = found.used == PoseGraphInitialization::kCertified;
    report.rejected = std::move(robust.rejected);
    report.loops_judged = robust.judged;
  }
  if (!found.solution.regular) report.free = find_free_directions(graph, options.rotation_error);
  report.outcome = found.solution.outcome;
  report.iterations = found.solution.iterations;
  report.initialization_used = found.used;
  report.refined_from_certified = found.refined_from_certified;
}

/// Adds the result for a component.
void add_component(const GraphPart& part, PoseGraphReport&& of_part, PoseGraphReport& report) {
  if (report.outcome && !of_part.outcome)
    report.outcome = Outcome::failure(
        of_part.outcome.code,
        "component of node " + to_string(part.graph.nodes[0].id) + ": " + of_part.outcome.reason);
  report.iterations += of_part.iterations;
  report.initialization_used = std::max(report.initialization_used, of_part.initialization_used);
  report.refined_from_certified |= of_part.refined_from_certified;
  report.loops_judged &= of_part.loops_judged;
  for (RejectedEdge& edge : of_part.rejected) {
    edge.constraint = part.constraints[edge.constraint];
    report.rejected.push_back(std::move(edge));
  }
  report.free.count = std::min(report.free.count + of_part.free.count, FreeDirections::kMost);
  for (const int node : of_part.free.nodes) report.free.nodes.push_back(part.nodes[node]);
}

/// Optimizes every component by itself: none has an influence on another one.
template <class Group>
void minimize_components(const PoseGraph& graph, PackedGraph<Group>& packed,
                         const LocalSolverOptions& local, const PoseGraphOptions& options,
                         PoseGraphReport& report) {
  if (packed.components.count() <= 1) return minimize(packed, local, options, report);
  report.outcome = Outcome::ok();
  for (const GraphPart& part : split_components(graph)) {
    if (part.graph.constraints.empty()) continue;
    PackedGraph<Group> packed_part = pack<Group>(part.graph);
    PoseGraphReport of_part;
    minimize(packed_part, local, options, of_part);
    for (std::size_t i = 0; i < part.nodes.size(); ++i)
      packed.poses[part.nodes[i]] = packed_part.poses[i];
    add_component(part, std::move(of_part), report);
  }
  std::ranges::sort(report.free.nodes);
  std::ranges::sort(report.rejected, {}, &RejectedEdge::constraint);
}

template <class Group>
PoseGraphReport optimize(PoseGraph graph, const PoseGraphOptions& options,
                         const LogSink& log_sink) {
  PackedGraph<Group> packed = pack<Group>(graph);
  PoseGraphReport report;
  const std::vector<double> initial = packed_chi2(packed, options.rotation_error);
  minimize_components(graph, packed,
                      {.engine = options.engine,
                       .rotation_error = options.rotation_error,
                       .step_rule = options.step_rule,
                       .max_iterations = options.max_iterations,
                       .relative_decrease = options.relative_decrease,
                       .log = log_sink},
                      options, report);
  unpack(packed, graph);
  report.graph = std::move(graph);
  report.chi2_by_constraint = packed_chi2(packed, options.rotation_error);
  report.chi2_initial = sum_of_kept(initial, report.rejected);
  report.chi2_final = sum_of_kept(report.chi2_by_constraint, report.rejected);
  report.degrees_of_freedom =
      report.rejected.empty()
          ? packed.components.degrees_of_freedom
          : find_components(without_rejected(report.graph, report.rejected)).degrees_of_freedom;
  if (report.outcome) report.doubts = doubts_of(report, options.robust.method);
  log(log_sink, LogLevel::kInfo,
      "pose graph: chi2 {:f} -> {:f} in {} iterations, initialization {}", report.chi2_initial,
      report.chi2_final, report.iterations, to_string(report.initialization_used));
  return report;
}

}  // namespace

PoseGraphReport optimize_pose_graph(PoseGraph graph, const PoseGraphOptions& options,
                                    const LogSink& log) {
  options.check();
  graph.check();
  switch (graph.kind()) {
    case PoseKind::kSE2:
      return optimize<SE2>(std::move(graph), options, log);
    case PoseKind::kSE3:
      return optimize<SE3>(std::move(graph), options, log);
    case PoseKind::kSim3:
      break;
  }
  return optimize<Sim3>(std::move(graph), options, log);
}

PoseGraph without_rejected(PoseGraph graph, const std::vector<RejectedEdge>& rejected) {
  std::vector<char> is_rejected(graph.constraints.size());
  for (const RejectedEdge& edge : rejected) is_rejected.at(edge.constraint) = true;
  std::size_t i = 0;
  std::erase_if(graph.constraints, [&](const Constraint&) { return is_rejected[i++] != 0; });
  return graph;
}

std::vector<double> chi2_by_constraint(const PoseGraph& graph, RotationError rotation_error) {
  graph.check();
  switch (graph.kind()) {
    case PoseKind::kSE2:
      return packed_chi2(pack<SE2>(graph), rotation_error);
    case PoseKind::kSE3:
      return packed_chi2(pack<SE3>(graph), rotation_error);
    case PoseKind::kSim3:
      break;
  }
  return packed_chi2(pack<Sim3>(graph), rotation_error);
}

double chi2(const PoseGraph& graph, RotationError rotation_error) {
  return sum(chi2_by_constraint(graph, rotation_error));
}

}  // namespace placegraph
