#include "apps/graph/cmd_optimize.h"

#include <fmt/format.h>
#include <placegraph/eval/plots/pose_graph_plot.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/pose_graph_file.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>

#include "apps/graph/graph_solution.h"
#include "apps/graph/landmark_solution.h"
#include "apps/support/output.h"
#include "apps/support/plot_file.h"

namespace placegraph::apps {
namespace {

/// A choice among the options of the backend, by its path: its names and default stand there.
OptionEntry backend_option(const std::string& path) {
  for (OptionEntry& entry : list_options(PoseGraphOptions()))
    if (entry.path == path) return entry;
  throw ArgumentError("no option of the backend: " + path);
}

struct OptimizeArguments {
  std::string in, out, plot, cost = "log";
  std::string engine = backend_option("engine").value, start = backend_option("start").value,
              robust = backend_option("robust.method").value;
  bool json = false, force = false, quiet = false, drop_rejected = false;
  GraphTask task;
};

/// chi2 of the graph in both conventions, over the constraints that are not left out.
struct Costs {
  double g2o, log;
};

PoseGraph without(PoseGraph graph, const std::vector<RejectedEdge>& rejected) {
  std::vector<char> is_rejected(graph.constraints.size());
  for (const RejectedEdge& edge : rejected) is_rejected[edge.constraint] = true;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < graph.constraints.size(); ++i)
    if (!is_rejected[i]) std::swap(graph.constraints[kept++], graph.constraints[i]);
  graph.constraints.resize(kept);
  return graph;
}

Costs costs_of(const PoseGraph& graph) {
  return {chi2(graph, RotationError::kQuaternion), chi2(graph, RotationError::kLog)};
}

using Json = nlohmann::ordered_json;

Json rejected_edges(const GraphSolution& solution) {
  Json list = Json::array();
  for (const RejectedEdge& rejected : solution.rejected) {
    const auto& edge =
        std::get<RelativePoseConstraint>(solution.graph.constraints[rejected.constraint]);
    list.push_back({{"from", edge.from},
                    {"to", edge.to},
                    {"chi2", rejected.chi2},
                    {"reason", rejected.reason}});
  }
  return list;
}

/// Edges that were kept though their chi2 at the solution is beyond the 99.9 % bound.
int doubtful_edges(const GraphSolution& solution) {
  if (solution.chi2_by_constraint.empty()) return 0;
  const double bound = chi_squared_quantile(0.999, degrees_of_freedom(solution.graph.kind()));
  const auto beyond =
      std::count_if(solution.chi2_by_constraint.begin(), solution.chi2_by_constraint.end(),
                    [&](double chi2) { return chi2 > bound; });
  const auto rejected = std::count_if(
      solution.rejected.begin(), solution.rejected.end(),
      [&](const auto& edge) { return solution.chi2_by_constraint[edge.constraint] > bound; });
  return static_cast<int>(beyond - rejected);
}

/// One line where the least squares of a graph with loops look like those of a wrong graph.
void warn_of_misfit(const OptimizeArguments& arguments, const GraphSolution& solution,
                    const Costs& costs) {
  constexpr double kMuch = 10;  // times what is expected
  const int dof = degrees_of_freedom(solution.graph.kind());
  const auto free = static_cast<double>(solution.graph.constraints.size()) -
                    static_cast<double>(solution.graph.nodes.size()) + solution.components;
  const double expected = dof * std::max(1.0, free);
  if (arguments.robust != "none" || costs.log < kMuch * expected) return;
  std::fprintf(stderr,
               "placegraph: %s: chi2 is %.0f times what the information of the edges lets expect: "
               "false loops (try --robust auto), or information that promises too much\n",
               arguments.in.c_str(), costs.log / expected);
}

/// "3, 5, 7 and 12 more"
std::string some_ids(const Json& ids) {
  constexpr std::size_t kMost = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(kMost, ids.size()); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : ", ", ids[i].get<std::int64_t>());
  if (ids.size() > kMost) text += fmt::format(" and {} more", ids.size() - kMost);
  return text;
}

/// One line where another start may end elsewhere at the same cost.
void warn_of_free_directions(const OptimizeArguments& arguments, const Json& report) {
  const int count = report["free_directions"].get<int>();
  const Json& vertices = report["free_vertices"];
  if (count == 0) return;
  warn(
      fmt::format("{}: the minimum is not unique: the constraints leave {}{} directions free, at "
                  "{} vertices ({}); their information may have been written in another order, or "
                  "has zeros",
                  arguments.in, count >= FreeDirections::kMost ? "at least " : "", count,
                  vertices.size(), some_ids(vertices)));
}

/// One line where parts of a graph with priors or landmarks stand for themselves.
void warn_of_parts(const OptimizeArguments& arguments, const Json& report) {
  const Json& held = report["held_vertices"];
  if (report["components"].get<int>() < 2 || held.empty()) return;
  warn(
      fmt::format("{}: the graph falls into {} components, of which {} are tied to the world by "
                  "no prior and no FIX: each keeps a vertex where it is ({})",
                  arguments.in, report["components"].get<int>(), held.size(), some_ids(held)));
}

void describe_free_directions(const GraphSolution& solution, Json& report) {
  report["free_directions"] = solution.free.count;
  report["free_vertices"] = Json::array();
  for (const int node : solution.free.nodes)
    report["free_vertices"].push_back(solution.graph.nodes[node].id);
}

void describe_steps(std::vector<double> cpu_ms, Json& report) {
  if (cpu_ms.empty()) return;
  std::sort(cpu_ms.begin(), cpu_ms.end());
  const std::size_t count = cpu_ms.size();
  report["steps"] = count;
  report["step_cpu_ms_mean"] =
      std::accumulate(cpu_ms.begin(), cpu_ms.end(), 0.0) / static_cast<double>(count);
  report["step_cpu_ms_p95"] = cpu_ms[(count * 95 + 99) / 100 - 1];
  report["step_cpu_ms_max"] = cpu_ms.back();
}

void describe_certificate(const GraphSolution& solution, Json& report) {
  report["refined_from_certified"] = solution.refined_from_certified;
  report["certified"] = solution.certificate && solution.certificate->certified;
  report["certified_problem"] = nullptr;
  if (!solution.certificate) return;
  const ChordalIsotropicCertificate& certificate = *solution.certificate;
  report["certified_problem"] = ChordalIsotropicCertificate::kProblem;
  report["certificate_gap"] = certificate.relative_gap;
  report["certificate_cost"] = certificate.cost;
  report["certificate_cost_of_estimate"] = certificate.cost_of_estimate;
  report["certificate_lower_bound"] = certificate.lower_bound;
  report["smallest_eigenvalue"] = certificate.smallest_eigenvalue;
  report["eigenvalue_scale"] = certificate.eigenvalue_scale;
  report["certificate_cpu_ms"] = solution.certificate_cpu_ms;
}

Json describe(const OptimizeArguments& arguments, const Costs& before, const Costs& after,
              const GraphSolution& solution) {
  const char* const kinds[] = {"SE2", "SE3", "Sim3"};
  Json report;
  report["in"] = arguments.in;
  report["out"] = arguments.out;
  report["cost"] = arguments.cost;
  report["engine"] = arguments.engine;
  report["start"] = solution.start;
  report["robust"] = arguments.robust;
  report["kind"] = kinds[static_cast<int>(solution.graph.kind())];
  report["nodes"] = solution.graph.nodes.size();
  report["constraints"] = solution.graph.constraints.size();
  report["components"] = solution.components;
  report["chi2_g2o_initial"] = before.g2o;
  report["chi2_log_initial"] = before.log;
  report["chi2_g2o"] = after.g2o;
  report["chi2_log"] = after.log;
  report["iterations"] = solution.iterations;
  report["cpu_ms"] = solution.cpu_ms;
  report["wall_ms"] = solution.wall_ms;
  report["peak_mb"] = solution.peak_mb;
  describe_free_directions(solution, report);
  describe_certificate(solution, report);
  describe_steps(solution.step_cpu_ms, report);
  report["loops_judged"] = arguments.robust != "none" && solution.loops_judged;
  report["rejected"] = solution.rejected.size();
  report["rejected_edges"] = rejected_edges(solution);
  report["doubtful"] = doubtful_edges(solution);
  return report;
}

void print(const OptimizeArguments& arguments, const Json& report) {
  const auto number = [&](const char* key) { return report[key].get<double>(); };
  fmt::print("{}: {}, {} nodes, {} constraints, minimized in the {} convention\n", arguments.in,
             report["kind"].get<std::string>(), report["nodes"].get<int>(),
             report["constraints"].get<int>(), arguments.cost);
  if (const int components = report["components"].get<int>(); components > 1)
    fmt::print("  {} components, each for itself\n", components);
  fmt::print("  chi2 (g2o: half-angle quaternion) {:.6f} -> {:.6f}\n", number("chi2_g2o_initial"),
             number("chi2_g2o"));
  fmt::print("  chi2 (logarithm)                  {:.6f} -> {:.6f}\n", number("chi2_log_initial"),
             number("chi2_log"));
  if (!report["rejected_edges"].empty())
    fmt::print("  {} constraints rejected\n", report["rejected_edges"].size());
  if (const int doubtful = report["doubtful"].get<int>();
      doubtful > 0 && arguments.robust != "none")
    fmt::print("  {} constraints kept that lie beyond the 99.9 % bound of their chi2{}\n", doubtful,
               arguments.robust == "huber" || arguments.robust == "dcs"
                   ? "; the method gives them less weight, chi2 above counts them in full"
                   : "");
  if (report.contains("certificate_gap"))
    fmt::print(
        "  {}: the isotropic chordal problem's minimum here lies at most {:.2g} above its "
        "global one (smallest eigenvalue {:.3g})\n",
        report["certified"].get<bool>() ? "certified" : "not certified", number("certificate_gap"),
        number("smallest_eigenvalue"));
  if (report.contains("steps"))
    fmt::print("  {} steps of {:.2f} ms CPU on average, 95 % below {:.2f}, at most {:.2f}\n",
               report["steps"].get<int>(), number("step_cpu_ms_mean"), number("step_cpu_ms_p95"),
               number("step_cpu_ms_max"));
  fmt::print("  {} iterations, {:.1f} ms CPU, {:.1f} ms wall, {:.0f} MB at most; written to {}\n",
             report["iterations"].get<int>(), number("cpu_ms"), number("wall_ms"),
             number("peak_mb"), arguments.out);
}

void draw(const OptimizeArguments& arguments, const PoseGraph& before,
          const GraphSolution& solution, const Costs& costs) {
  std::vector<int> rejected;
  for (const RejectedEdge& edge : solution.rejected) rejected.push_back(edge.constraint);
  Plot plot = plot_of(before, solution.graph, rejected);
  plot.title = fmt::format("{} poses, {} constraints, chi2 {:.5g} (log), {:.5g} (g2o)",
                           solution.graph.nodes.size(), solution.graph.constraints.size(),
                           costs.log, costs.g2o);
  write_plot(arguments.plot, plot);
}

/// The value of a choice by its name, which the command line has checked.
template <class Enum>
Enum chosen(const std::string& path, const std::string& name) {
  const std::vector<std::string> names = backend_option(path).choices;
  return static_cast<Enum>(std::find(names.begin(), names.end(), name) - names.begin());
}

void check(OptimizeArguments& arguments) {
  PoseGraphOptions& options = arguments.task.options;
  options.rotation_error =
      arguments.cost == "g2o" ? RotationError::kQuaternion : RotationError::kLog;
  options.engine = chosen<PoseGraphEngine>("engine", arguments.engine);
  options.start = chosen<PoseGraphStart>("start", arguments.start);
  options.robust.method = chosen<RobustMethod>("robust.method", arguments.robust);
  options.check();
  require(
      !arguments.task.incremental ||
          (arguments.robust == "none" && arguments.engine == "native" && arguments.start == "auto"),
      "--incremental goes with --engine native, --robust none and --start auto");
  require(!arguments.drop_rejected || arguments.robust != "none",
          "--drop-rejected goes with --robust, which rejects");
  require_plot_name(arguments.plot);
  require(arguments.plot.empty() || arguments.plot != arguments.out,
          "--plot: " + arguments.plot + " is where the graph is to be written");
  require_free(arguments.out, arguments.force);
  if (!arguments.plot.empty()) require_free(arguments.plot, arguments.force);
}

/// Graphs with priors and point landmarks: what belongs to pose graphs alone is refused.
void run_landmarks(const OptimizeArguments& arguments, LandmarkGraph graph) {
  const PoseGraphOptions& options = arguments.task.options;
  require(options.robust.method == RobustMethod::kNone && !arguments.task.incremental &&
              !arguments.task.split && !arguments.task.certify &&
              (options.start == PoseGraphStart::kAuto || options.start == PoseGraphStart::kFile) &&
              arguments.plot.empty(),
          arguments.in +
              ": has priors or point landmarks, which --robust, --incremental, "
              "--components, --certify, --plot and --start odometry, chordal and "
              "certified do not take");
  require(
      options.rotation_error == RotationError::kLog ||
          std::ranges::none_of(graph.priors, &PosePriorConstraint::beside_node),
      arguments.in +
          ": has priors of a sensor that stands beside its vertex (PARAMS_SE3OFFSET), which are "
          "exact for --cost log alone");
  Json report;
  report["in"] = arguments.in;
  report["out"] = arguments.out;
  report["cost"] = arguments.cost;
  try {
    report.update(solve_landmarks(graph, options));
  } catch (const NoAnswer& reason) {
    throw NoAnswer(arguments.in + ": " + reason.what());
  }
  if (!std::isfinite(report["chi2_log"].get<double>()))
    throw NoAnswer(arguments.in + ": the cost of the solution is not finite");
  warn_of_free_directions(arguments, report);
  warn_of_parts(arguments, report);
  write_g2o(arguments.out, graph);
  if (arguments.json)
    std::puts(report.dump(2).c_str());
  else
    print_landmarks(report);
}

void run(OptimizeArguments arguments) {
  check(arguments);
  std::vector<std::string> remarks;
  LandmarkGraph read =
      read_landmark_graph(arguments.in, {.connected = !arguments.task.split, .remarks = &remarks});
  for (const std::string& remark : remarks) warn(arguments.in + ": " + remark);
  if (!read.has_poses_alone()) return run_landmarks(arguments, std::move(read));
  PoseGraph start = std::move(read.poses);
  const Costs before = costs_of(start);
  if (!std::isfinite(before.g2o + before.log))
    throw FileError(arguments.in, "the cost at the given poses is not finite: numbers too large");
  const PoseGraph drawn = arguments.plot.empty() ? PoseGraph() : start;
  LogSink log;
  if (!arguments.quiet)
    log = [](LogLevel, const std::string& message) {
      std::fprintf(stderr, "%s\n", message.c_str());
    };
  GraphSolution solution;
  try {
    solution = solve(std::move(start), arguments.task, log);
  } catch (const NoAnswer& reason) {
    throw NoAnswer(arguments.in + ": " + reason.what());
  }
  const PoseGraph kept = without(solution.graph, solution.rejected);
  const Costs after = costs_of(kept);
  if (!std::isfinite(after.g2o + after.log))
    throw NoAnswer(arguments.in + ": the cost of the solution is not finite");
  if (!arguments.plot.empty()) draw(arguments, drawn, solution, after);
  if (!arguments.quiet) warn_of_misfit(arguments, solution, after);
  const Json report = describe(arguments, before, after, solution);
  warn_of_free_directions(arguments, report);
  if (!solution.loops_judged)
    warn(arguments.in + ": too few loops agree to know the noise's scale: --robust " +
         arguments.robust + " judged none of them, and left none out");
  write_g2o(arguments.out, arguments.drop_rejected ? kept : solution.graph);
  if (arguments.json)
    std::puts(report.dump(2).c_str());
  else
    print(arguments, report);
}

}  // namespace

void add_optimize_command(CLI::App& app) {
  auto arguments = std::make_shared<OptimizeArguments>();
  OptimizeArguments& a = *arguments;
  CLI::App* command =
      app.add_subcommand("optimize", "Optimize a pose graph in the form of g2o, TORO or iSAM");
  command->footer("placegraph optimize sphere.g2o -o optimized.g2o --cost g2o --plot sphere.png");
  command->add_option("IN", a.in, "graph to read: 2D, 3D or similarities")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("-o,--out", a.out, "graph to write, in g2o's form")->required();
  command
      ->add_option("--cost", a.cost,
                   "rotation error that is minimized: log, or g2o (vector part of the quaternion)")
      ->check(CLI::IsMember({"log", "g2o"}))
      ->capture_default_str();
  command->add_option("--engine", a.engine, "solver: native, or ceres (a second opinion)")
      ->check(CLI::IsMember(backend_option("engine").choices))
      ->capture_default_str();
  command->add_option("--start", a.start, "where the descent begins; auto goes as far as it must")
      ->check(CLI::IsMember(backend_option("start").choices))
      ->capture_default_str();
  command->add_option("--robust", a.robust, "what is done against false loops")
      ->check(CLI::IsMember(backend_option("robust.method").choices))
      ->capture_default_str();
  command->add_option("--iterations", a.task.options.max_iterations, "of a descent at most")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_flag("--certify", a.task.certify,
                    "prove how far the isotropic chordal problem is from its global minimum");
  command->add_flag("--incremental", a.task.incremental,
                    "let the graph grow pose by pose, as it would on a robot");
  command->add_flag("--components", a.task.split,
                    "optimize the parts of a graph that falls apart, each for itself");
  command->add_flag("--drop-rejected", a.drop_rejected, "write OUT without rejected constraints");
  command->add_option("--plot", a.plot, "draw the poses before and after (.png or .svg)");
  command->add_flag("--json", a.json, "print JSON");
  command->add_flag("--quiet", a.quiet, "no progress on stderr");
  command->add_flag("--force", a.force, "overwrite OUT and the plot");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace placegraph::apps
