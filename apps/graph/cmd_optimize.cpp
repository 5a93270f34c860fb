#include "apps/graph/cmd_optimize.h"

#include <placegraph/io/graphs/pose_graph_file.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

struct OptimizeCommand {
  OptimizeArguments arguments;
  bool json = false, quiet = false;
  std::function<void(const OptimizeArguments&, const OptimizeResult&)> write_page;
};

void run(const OptimizeCommand& command) {
  const LogSink sink = [&](LogLevel level, const std::string& message) {
    if (!command.quiet || level == LogLevel::kWarning) note(message);
  };
  const OptimizeResult result = optimize(command.arguments, sink);
  print(command.json ? to_json(result) : to_text(result));
  if (!command.arguments.report.empty()) command.write_page(command.arguments, result);
}

}  // namespace

void add_optimize_command(
    CLI::App& graph,
    const std::function<void(const OptimizeArguments&, const OptimizeResult&)>& write_page) {
  auto optimize_command = std::make_shared<OptimizeCommand>();
  optimize_command->write_page = write_page;
  OptimizeArguments& a = optimize_command->arguments;
  CLI::App* command = graph.add_subcommand(
      "optimize", "Optimize a pose graph in g2o, TORO or iSAM format (short: optimize)");
  command->footer(
      "placegraph graph optimize sphere.g2o -o optimized.g2o --cost g2o --plot sphere.png");
  command->add_option("IN", a.in, "graph to read: 2D, 3D or similarities")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("-o,--out", a.out, "file for the optimized graph, in g2o format")
      ->type_name(kOutput)
      ->required();
  command
      ->add_option("--cost", a.cost,
                   "rotation error that is minimized: log, or g2o (vector part of the quaternion)")
      ->check(CLI::IsMember(optimize_costs()))
      ->capture_default_str();
  command->add_option("--engine", a.engine, "solver: native, or ceres (a second opinion)")
      ->check(CLI::IsMember(pose_graph_option("engine").choices))
      ->capture_default_str();
  command
      ->add_option("--initialization", a.initialization,
                   "initial poses; auto computes better ones if they are needed")
      ->check(CLI::IsMember(pose_graph_option("initialization").choices))
      ->capture_default_str();
  command->add_option("--robust", a.robust, "method against false loops")
      ->check(CLI::IsMember(pose_graph_option("robust.method").choices))
      ->capture_default_str();
  command
      ->add_option("--indefinite", a.indefinite,
                   "edges of indefinite information: refuse them, or take the nearest matrix, or "
                   "isotropic weights")
      ->check(CLI::IsMember(indefinite_information_names()))
      ->capture_default_str();
  command->add_option("--iterations", a.task.options.max_iterations, "largest number of iterations")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_flag("--certify", a.task.certify,
                    "prove how far the isotropic chordal problem is from its global minimum");
  command->add_flag("--incremental", a.task.incremental,
                    "incremental optimization, pose by pose, as on a robot");
  command->add_flag("--components", a.task.split,
                    "optimize each component of a disconnected graph separately");
  command->add_flag("--drop-rejected", a.drop_rejected, "leave rejected constraints out of OUT");
  command
      ->add_option("--covariances", a.covariances,
                   "file for the covariance of every pose of the optimized graph (.csv)")
      ->type_name(kOutput);
  command->add_option("--plot", a.plot, kPlotText)->type_name(kOutput);
  command->add_option("--report", a.report, kReportText)->type_name(kOutput);
  command->add_flag("--json", optimize_command->json, kJsonText);
  command->add_flag("--quiet", optimize_command->quiet, "print warnings and errors only");
  command->add_flag("--force", a.force, kForceText);
  command->callback([optimize_command] { run(*optimize_command); });
}

}  // namespace placegraph::apps
