#include "apps/graph/landmark_solution.h"

#include <fmt/format.h>
#include <placegraph/backend/factor_graph/landmark_graph_optimizer.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/support/output.h"
#include "apps/support/usage.h"

namespace placegraph::apps {

using Json = nlohmann::ordered_json;

namespace {

std::int64_t id_of(const LandmarkGraph& graph, int variable) {
  const auto i = static_cast<std::size_t>(variable), nodes = graph.poses.nodes.size();
  return i < nodes ? graph.poses.nodes[i].id : graph.points[i - nodes].id;
}

}  // namespace

Json solve_landmarks(LandmarkGraph& graph, const PoseGraphOptions& options) {
  const Stopwatch stopwatch;
  Json report;
  report["kind"] = graph.poses.kind() == PoseKind::kSE2 ? "SE2" : "SE3";
  report["engine"] = options.engine == PoseGraphEngine::kCeres ? "ceres" : "native";
  report["start"] = to_string(PoseGraphStart::kFile);
  report["robust"] = "none";
  report["nodes"] = graph.poses.nodes.size();
  report["constraints"] = graph.poses.constraints.size();
  report["priors"] = graph.priors.size();
  report["landmarks"] = graph.points.size();
  report["sights"] = graph.sights.size();
  report["components"] = count_components(graph);
  const bool exact = std::ranges::none_of(graph.priors, &PosePriorConstraint::beside_node);
  const auto g2o_cost = [exact](const LandmarkGraph& at) {
    return exact ? Json(chi2(at, RotationError::kQuaternion)) : Json();
  };
  report["chi2_g2o_initial"] = g2o_cost(graph);
  report["chi2_log_initial"] = chi2(graph, RotationError::kLog);
  LandmarkGraphReport solved = optimize_landmark_graph(
      std::move(graph),
      {options.rotation_error, options.engine, options.max_iterations, options.relative_decrease});
  if (!solved.outcome) throw NoAnswer(solved.outcome.reason);
  graph = std::move(solved.graph);
  report["chi2_g2o"] = g2o_cost(graph);
  report["chi2_log"] = chi2(graph, RotationError::kLog);
  report["iterations"] = solved.iterations;
  report["cpu_ms"] = stopwatch.cpu_ms();
  report["wall_ms"] = stopwatch.wall_ms();
  report["peak_mb"] = peak_mb();
  report["free_directions"] = solved.free.count;
  report["free_vertices"] = Json::array();
  for (const int node : solved.free.nodes) report["free_vertices"].push_back(id_of(graph, node));
  report["rejected"] = 0;
  report["rejected_edges"] = Json::array();
  report["held_vertices"] = Json::array();
  for (const int node : held_for_want_of_a_tie(graph))
    report["held_vertices"].push_back(id_of(graph, node));
  return report;
}

void print_landmarks(const Json& report) {
  const auto text = [&](const char* key) { return report[key].get<std::string>(); };
  const auto count = [&](const char* key) { return report[key].get<std::size_t>(); };
  const auto number = [&](const char* key) { return report[key].get<double>(); };
  fmt::print(
      "{}: {}, {} nodes, {} constraints, {} priors, {} landmarks seen {} times, minimized "
      "in the {} convention\n",
      text("in"), text("kind"), count("nodes"), count("constraints"), count("priors"),
      count("landmarks"), count("sights"), text("cost"));
  if (!report["chi2_g2o"].is_null())
    fmt::print("  chi2 (g2o: half-angle quaternion) {:.6f} -> {:.6f}\n", number("chi2_g2o_initial"),
               number("chi2_g2o"));
  fmt::print("  chi2 (logarithm)                  {:.6f} -> {:.6f}\n", number("chi2_log_initial"),
             number("chi2_log"));
  fmt::print("  {} iterations, {:.1f} ms CPU, {:.0f} MB at most; written to {}\n",
             count("iterations"), number("cpu_ms"), number("peak_mb"), text("out"));
}

}  // namespace placegraph::apps
