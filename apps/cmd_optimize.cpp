#include "apps/cmd_optimize.h"

#include <fmt/format.h>
#include <placegraph/backend/pose_graph_optimizer.h>
#include <placegraph/io/g2o.h>
#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/output.h"

namespace placegraph::apps {
namespace {

struct Arguments {
  std::string in, out, cost = "log";
  bool json = false, force = false;
  PoseGraphOptions options;
};

void run(Arguments arguments) {
  arguments.options.rotation_error =
      arguments.cost == "g2o" ? RotationError::kQuaternion : RotationError::kLog;
  arguments.options.check();
  require_free(arguments.out, arguments.force);
  const PoseGraph start = read_g2o(arguments.in);

  const auto wall_begin = std::chrono::steady_clock::now();
  const std::clock_t cpu_begin = std::clock();
  const PoseGraphReport report = optimize_pose_graph(start, arguments.options);
  const double cpu_ms = 1e3 * static_cast<double>(std::clock() - cpu_begin) / CLOCKS_PER_SEC;
  const double wall_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - wall_begin)
          .count();
  if (!report.outcome) throw NoAnswer(arguments.in + ": " + report.outcome.reason);
  write_g2o(arguments.out, report.graph);

  nlohmann::ordered_json json;
  json["in"] = arguments.in;
  json["out"] = arguments.out;
  json["cost"] = arguments.cost;
  json["nodes"] = report.graph.nodes.size();
  json["constraints"] = report.graph.constraints.size();
  json["chi2_g2o_initial"] = chi2(start, RotationError::kQuaternion);
  json["chi2_log_initial"] = chi2(start, RotationError::kLog);
  json["chi2_g2o"] = chi2(report.graph, RotationError::kQuaternion);
  json["chi2_log"] = chi2(report.graph, RotationError::kLog);
  json["iterations"] = report.iterations;
  json["cpu_ms"] = cpu_ms;
  json["wall_ms"] = wall_ms;
  if (arguments.json) {
    std::puts(json.dump(2).c_str());
    return;
  }
  fmt::print("{}: {} nodes, {} constraints, minimized in the {} convention\n", arguments.in,
             report.graph.nodes.size(), report.graph.constraints.size(), arguments.cost);
  fmt::print("  chi2 (g2o: half-angle quaternion) {:.6f} -> {:.6f}\n",
             json["chi2_g2o_initial"].get<double>(), json["chi2_g2o"].get<double>());
  fmt::print("  chi2 (logarithm)                  {:.6f} -> {:.6f}\n",
             json["chi2_log_initial"].get<double>(), json["chi2_log"].get<double>());
  fmt::print("  {} iterations, {:.1f} ms CPU, {:.1f} ms wall; written to {}\n", report.iterations,
             cpu_ms, wall_ms, arguments.out);
}

}  // namespace

void add_optimize_command(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  Arguments& a = *arguments;
  CLI::App* command = app.add_subcommand("optimize", "Optimize a pose graph (.g2o, 2D or 3D)");
  command->footer("placegraph optimize sphere.g2o -o optimized.g2o --cost g2o --json");
  command->add_option("IN", a.in, "graph to read")->required()->check(CLI::ExistingFile);
  command->add_option("-o,--out", a.out, "graph to write")->required();
  command
      ->add_option("--cost", a.cost,
                   "rotation error that is minimized: log, or g2o (vector part of the quaternion)")
      ->check(CLI::IsMember({"log", "g2o"}))
      ->capture_default_str();
  command->add_option("--iterations", a.options.max_iterations, "at most")->capture_default_str();
  command->add_flag("--json", a.json, "print JSON");
  command->add_flag("--force", a.force, "overwrite OUT");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace placegraph::apps
