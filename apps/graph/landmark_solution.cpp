#include "apps/graph/landmark_solution.h"

#include <fmt/format.h>
#include <placegraph/backend/factor_graph/landmark_graph_optimizer.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/support/output.h"
#include "apps/support/usage.h"

namespace placegraph::apps {

using Json = nlohmann::ordered_json;

LandmarkSolution solve_landmarks(LandmarkGraph graph, const PoseGraphOptions& options) {
  const Stopwatch stopwatch;
  LandmarkSolution solution;
  solution.engine = options.engine == PoseGraphEngine::kCeres ? "ceres" : "native";
  solution.components = count_components(graph);
  const bool exact = std::ranges::none_of(graph.priors, &PosePriorConstraint::beside_node);
  const auto g2o_cost = [exact](const LandmarkGraph& at) {
    return exact ? std::optional(chi2(at, RotationError::kQuaternion)) : std::nullopt;
  };
  solution.chi2_g2o_initial = g2o_cost(graph);
  solution.chi2_log_initial = chi2(graph, RotationError::kLog);
  LandmarkGraphReport solved = optimize_landmark_graph(
      std::move(graph),
      {options.rotation_error, options.engine, options.max_iterations, options.relative_decrease});
  if (!solved.outcome) throw NoResult(solved.outcome.reason);
  solution.graph = std::move(solved.graph);
  solution.chi2_g2o = g2o_cost(solution.graph);
  solution.chi2_log = chi2(solution.graph, RotationError::kLog);
  solution.iterations = solved.iterations;
  solution.cpu_ms = stopwatch.cpu_ms();
  solution.wall_ms = stopwatch.wall_ms();
  solution.peak_mb = peak_mb();
  solution.free_directions = solved.free.count;
  for (const int node : solved.free.nodes)
    solution.free_vertices.push_back(id_of(solution.graph, node));
  for (const int node : held_for_want_of_a_tie(solution.graph))
    solution.held_vertices.push_back(id_of(solution.graph, node));
  solution.doubts = std::move(solved.doubts);
  solution.degrees_of_freedom = solved.degrees_of_freedom;
  return solution;
}

Json describe(const LandmarkSolution& solution) {
  const auto or_null = [](const std::optional<double>& cost) {
    return cost ? Json(*cost) : Json();
  };
  const LandmarkGraph& graph = solution.graph;
  Json report;
  report["kind"] = graph.poses.kind() == PoseKind::kSE2 ? "SE2" : "SE3";
  report["engine"] = solution.engine;
  report["initialization"] = to_string(PoseGraphInitialization::kFile);
  report["robust"] = "none";
  report["nodes"] = graph.poses.nodes.size();
  report["constraints"] = graph.poses.constraints.size();
  report["priors"] = graph.priors.size();
  report["landmarks"] = graph.points.size();
  report["sights"] = graph.observations.size();
  report["components"] = solution.components;
  report["degrees_of_freedom"] = solution.degrees_of_freedom;
  report["chi2_g2o_initial"] = or_null(solution.chi2_g2o_initial);
  report["chi2_log_initial"] = solution.chi2_log_initial;
  report["chi2_g2o"] = or_null(solution.chi2_g2o);
  report["chi2_log"] = solution.chi2_log;
  report["iterations"] = solution.iterations;
  report["cpu_ms"] = solution.cpu_ms;
  report["wall_ms"] = solution.wall_ms;
  report["peak_mb"] = solution.peak_mb;
  report["free_directions"] = solution.free_directions;
  report["free_vertices"] = solution.free_vertices;
  report["rejected"] = 0;
  report["rejected_edges"] = Json::array();
  report["held_vertices"] = solution.held_vertices;
  return report;
}

std::string to_text(const LandmarkSolution& solution, const std::string& in,
                    const std::string& cost, const std::string& out) {
  const LandmarkGraph& graph = solution.graph;
  std::string text = fmt::format(
      "{}: {}, {} nodes, {} constraints, {} priors, {} landmarks seen {} times, minimized "
      "in the {} convention\n",
      in, graph.poses.kind() == PoseKind::kSE2 ? "SE2" : "SE3", graph.poses.nodes.size(),
      graph.poses.constraints.size(), graph.priors.size(), graph.points.size(),
      graph.observations.size(), cost);
  if (solution.chi2_g2o && solution.chi2_g2o_initial)
    text += fmt::format("  chi2 (g2o: half-angle quaternion) {:.6f} -> {:.6f}\n",
                        *solution.chi2_g2o_initial, *solution.chi2_g2o);
  text += fmt::format("  chi2 (logarithm)                  {:.6f} -> {:.6f}\n",
                      solution.chi2_log_initial, solution.chi2_log);
  return text + fmt::format("  {} iterations, {:.1f} ms CPU, {:.0f} MB at most; written to {}\n",
                            solution.iterations, solution.cpu_ms, solution.peak_mb, out);
}

}  // namespace placegraph::apps
