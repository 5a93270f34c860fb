#include "apps/eval/cmd_eval.h"

#include <placegraph/eval/plots/evaluation_plot.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/eval/eval.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

struct EvalCommand {
  EvalArguments arguments;
  bool json = false;
  std::function<void(const EvalArguments&, const EvalResult&)> write_page;
};

void run(const EvalCommand& command) {
  const bool json = command.json;
  const EvalResult result = eval(command.arguments);
  const EvaluationResult* refused = result.refused();
  // A single estimate that cannot be evaluated is reported once, by the error.
  if (json || !refused || !result.single()) print(json ? to_json(result) : to_text(result));
  if (!refused && !command.arguments.report.empty()) command.write_page(command.arguments, result);
  if (refused) throw NoResult(refused->name + ": " + refused->outcome.reason);
}

void add_plot_options(CLI::App& command, EvalArguments& a) {
  command.add_option("--plot", a.plot, kPlotText)->type_name(kOutput);
  command
      .add_option("--plot-kind", a.plot_kinds,
                  "figures of --plot, joined by commas: overview, xyz, rpy, rpe, lengths, box, "
                  "violin; several go to FILE_KIND")
      ->delimiter(',')
      ->check(CLI::IsMember(evaluation_plot_names()))
      ->capture_default_str();
}

}  // namespace

void add_protocol_options(CLI::App& command, EvalArguments& a) {
  command.add_option("--align", a.align, "transformation fitted before the errors are computed")
      ->check(CLI::IsMember(eval_alignments()))
      ->capture_default_str();
  command
      .add_option("--lengths", a.options.segments.lengths_m,
                   "lengths of the segments [m], as 100,200,300")
      ->delimiter(',')
      ->capture_default_str();
  command.add_option("--step", a.options.segments.step, "frames between the starts of segments")
      ->capture_default_str();
  command
      .add_option("--associate", a.associate,
                   "how poses are paired: by index or by time; auto: by time if both have times")
      ->check(CLI::IsMember(eval_associations()))
      ->capture_default_str();
  command
      .add_option("--max-difference", a.options.time.max_difference_s,
                   "largest time difference of paired poses [s]")
      ->capture_default_str();
  command
      .add_option("--offset", a.options.time.offset_s,
                   "time added to the stamps of the estimate [s]")
      ->capture_default_str();
  command.add_option("--times", a.times, kTimesText)
      ->delimiter(',')
      ->expected(1)
      ->take_all()
      ->check(CLI::ExistingFile);
}

void add_eval_trajectory_command(
    CLI::App& eval_group,
    const std::function<void(const EvalArguments&, const EvalResult&)>& write_page) {
  auto eval_command = std::make_shared<EvalCommand>();
  eval_command->write_page = write_page;
  EvalArguments& a = eval_command->arguments;
  CLI::App* command = eval_group.add_subcommand(
      "trajectory", "Evaluate trajectories against ground truth (short: eval)");
  command->footer(
      "placegraph eval trajectory poses.txt trajectory_optimized.kitti --align se3 --plot e.png");
  command
      ->add_option("TRUTH", a.truth,
                   "true trajectory, the folder of a sequence, or a folder of trajectories")
      ->required()
      ->check(CLI::ExistingPath);
  command
      ->add_option(
          "ESTIMATE", a.estimates,
          "estimated trajectories or output folders of `run`, or one folder whose files are "
          "paired with TRUTH's by name")
      ->required()
      ->check(CLI::ExistingPath);
  add_protocol_options(*command, a);
  command->add_flag("--json", eval_command->json, kJsonText);
  command->add_option("--csv", a.csv, "write the details as CSV")->type_name(kOutput);
  command->add_option("--latex", a.latex, "write the figures as a LaTeX table")->type_name(kOutput);
  add_plot_options(*command, a);
  command->add_option("--report", a.report, kReportText)->type_name(kOutput);
  command->add_flag("--force", a.force, kForceText);
  command->callback([eval_command] { run(*eval_command); });
}

}  // namespace placegraph::apps
