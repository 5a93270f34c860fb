#include "apps/eval/cmd_eval.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/eval/eval.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

void run(const EvalArguments& arguments, bool json) {
  const EvalResult result = eval(arguments);
  print(json ? to_json(result) : to_text(result));
  if (const EvaluationResult* refused = result.refused())
    throw NoAnswer(refused->name + ": " + refused->outcome.reason);
}

}  // namespace

void add_eval_command(CLI::App& app) {
  auto arguments = std::make_shared<EvalArguments>();
  auto json = std::make_shared<bool>(false);
  EvalArguments& a = *arguments;
  CLI::App* command = app.add_subcommand(
      "eval", "Judge estimated trajectories against ground truth (KITTI, TUM or EuRoC form)");
  command->footer("placegraph eval poses.txt trajectory_optimized.kitti --align se3 --plot e.png");
  command
      ->add_option("GT", a.truth,
                   "true trajectory, a KITTI sequence's folder, or a folder of "
                   "trajectories")
      ->required()
      ->check(CLI::ExistingPath);
  command
      ->add_option("EST", a.estimates,
                   "estimates to compare, or one folder, whose files are paired with GT's by name")
      ->required()
      ->check(CLI::ExistingPath);
  command->add_option("--align", a.align, "what is fitted first: none, origin, se3, sim3 or scale")
      ->check(CLI::IsMember(eval_alignments()))
      ->capture_default_str();
  command
      ->add_option("--lengths", a.options.segments.lengths_m, "segment lengths [m], as 100,200,300")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--step", a.options.segments.step, "frames between segment starts")
      ->capture_default_str();
  command
      ->add_option("--associate", a.associate,
                   "how lines are paired: auto (by time if both have times), index or time")
      ->check(CLI::IsMember(eval_associations()))
      ->capture_default_str();
  command
      ->add_option("--max-difference", a.options.time.max_difference_s,
                   "largest difference of paired stamps [s]")
      ->capture_default_str();
  command->add_option("--offset", a.options.time.offset_s, "added to the estimate's stamps [s]")
      ->capture_default_str();
  command
      ->add_option("--times", a.times,
                   "times of KITTI files: one file for all, or two: ground truth's, estimate's")
      ->delimiter(',')
      ->expected(1)
      ->take_all()
      ->check(CLI::ExistingFile);
  command->add_flag("--json", *json, "print JSON");
  command->add_option("--csv", a.csv, "write figures and every segment's errors as CSV");
  command->add_option("--latex", a.latex, "write a LaTeX table");
  command->add_option("--plot", a.plot, "draw top view and error over distance (.png or .svg)");
  command->add_flag("--force", a.force, "overwrite files");
  command->callback([arguments, json] { run(*arguments, *json); });
}

}  // namespace placegraph::apps
