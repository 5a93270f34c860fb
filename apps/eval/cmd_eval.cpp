#include "apps/eval/cmd_eval.h"

#include <placegraph/eval/plots/evaluation_plot.h>
#include <placegraph/graph/core/error.h>

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
  if (!refused) return;
  const std::string reason = refused->name + ": " + refused->outcome.reason;
  // What does not belong together is wrong input; what allows no figure is a result.
  if (refused->outcome.code == Outcome::Code::kInconsistent) throw ArgumentError(reason);
  throw NoResult(reason);
}

/// Which poses are compared, and what is removed before.
void add_pairing_options(CLI::App& command, EvalArguments& a) {
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
  command
      .add_option("--estimate", a.estimated,
                  "constant offsets that are estimated and removed first: body (the pose between "
                  "the two bodies), time, or body,time")
      ->delimiter(',')
      ->expected(1)
      ->take_all()
      ->check(CLI::IsMember({"body", "time"}));
  command.add_option("--times", a.times, kTimesText)
      ->delimiter(',')
      ->expected(1)
      ->take_all()
      ->check(CLI::ExistingFile);
}

void add_output_options(CLI::App& command, EvalArguments& a) {
  command
      .add_option("--evo-results", a.evo_results,
                  "write the position errors of one estimate as a result archive of evo (.zip)")
      ->type_name(kOutput);
  command.add_option("--plot", a.plot, kPlotText)->type_name(kOutput);
  command
      .add_option("--plot-kind", a.plot_kinds,
                  "figures of --plot, joined by commas: overview, xyz, rpy, rpe, lengths, box, "
                  "violin; several go to FILE_KIND")
      ->delimiter(',')
      ->check(CLI::IsMember(evaluation_plot_names()))
      ->capture_default_str();
  command
      .add_option("--map", a.map,
                  "map under the view from above, in the frame of the truth: .yaml of an occupancy "
                  "grid (ROS), or a picture beside its world file")
      ->check(CLI::ExistingFile);
  command
      .add_option("--map-corners", a.map_corners_m,
                  "corners of a picture of --map: x,y of the lower left and of the upper right [m]")
      ->delimiter(',');
  command
      .add_option("--plot-settings", a.plot_settings,
                  "YAML file of size, fonts, colours, limits and units of the figures")
      ->check(CLI::ExistingFile);
}

void add_alignment_options(CLI::App& command, EvalArguments& a) {
  command.add_option("--align", a.align, "transformation fitted before the errors are computed")
      ->check(CLI::IsMember(eval_alignments()))
      ->capture_default_str();
  command.add_option("--align-frames", a.align_frames,
                     "fit it to the frames A:B of the ground truth (B is the first behind them)");
  command.add_option("--align-seconds", a.align_seconds,
                     "fit it to the seconds A:B since the first posed frame");
  command.add_option("--align-first", a.align_first, "fit it to the first N posed frames")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--vertical", a.vertical,
                  "vertical of the ground truth's world, for --align yaw and errors along it")
      ->check(CLI::IsMember(eval_verticals()))
      ->capture_default_str();
}

void add_error_options(CLI::App& command, EvalArguments& a) {
  command
      .add_option("--delta", a.deltas,
                  "relative errors over steps of 10f (frames), 1s, 5m or 10deg; several joined by "
                  "commas")
      ->delimiter(',');
  command.add_flag("--all-pairs", a.all_pairs,
                   "begin a step of --delta at every pose; default: where the one before ends");
  command
      .add_option("--below", a.below,
                  "shares of the drive with errors below 0.1m (position) or 1deg (rotation); several "
                  "joined by commas")
      ->delimiter(',');
  command
      .add_option("--part", a.part,
                  "part of the position errors that is judged: in a plane, or along an axis")
      ->check(CLI::IsMember(eval_parts()))
      ->capture_default_str();
}

}  // namespace

void add_protocol_options(CLI::App& command, EvalArguments& a) {
  add_alignment_options(command, a);
  add_error_options(command, a);
  command
      .add_option("--lengths", a.options.segments.lengths_m,
                  "lengths of the segments [m], as 100,200,300")
      ->delimiter(',')
      ->capture_default_str();
  command.add_option("--step", a.options.segments.step, "frames between the starts of segments")
      ->capture_default_str();
  add_pairing_options(command, a);
  command.add_option("--apply", a.apply, kApplyText);
  command.add_option("--apply-truth", a.apply_truth, "the same for the ground truth");
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
  command->add_flag("--intervals", a.options.intervals,
                   "confidence intervals of the figures, and comparisons with the first estimate");
  command->add_flag("--repeated-runs", a.repeated_runs,
                   "the estimates are runs of one system: means and intervals over them");
  command->add_flag("--json", eval_command->json, kJsonText);
  command->add_option("--csv", a.csv, "write the details as CSV")->type_name(kOutput);
  command->add_option("--latex", a.latex, "write the figures as a LaTeX table")->type_name(kOutput);
  add_output_options(*command, a);
  command->add_option("--report", a.report, kReportText)->type_name(kOutput);
  command->add_flag("--force", a.force, kForceText);
  command->callback([eval_command] { run(*eval_command); });
}

}  // namespace placegraph::apps
