#include "apps/eval/benchmarks/cmd_eval_kitti.h"

#include <placegraph/eval/kitti/kitti_report.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/kitti/kitti_files.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/eval/benchmarks/eval_kitti.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

void print_kitti(const EvalKittiArguments& arguments, bool json) {
  const KittiBenchmark benchmark = eval_kitti(arguments);
  print(json ? to_json(benchmark) : to_text(benchmark));
  for (const KittiSystem& system : benchmark.systems)
    if (!system.faults.empty())
      throw ArgumentError(system.name +
                          ": is not fit to be submitted: " + to_string(system.faults.front()));
}

}  // namespace

void add_eval_kitti_command(CLI::App& eval_group) {
  auto arguments = std::make_shared<EvalKittiArguments>();
  auto json = std::make_shared<bool>(false);
  EvalKittiArguments& a = *arguments;
  CLI::App* command = eval_group.add_subcommand(
      "kitti", "Judge submissions to KITTI's odometry benchmark as its devkit does");
  command->footer("placegraph eval kitti kitti/poses results --out judged");
  command->add_option("TRUTHS", a.truth, "folder of true poses: 00.txt ..., or 00/poses.txt ...")
      ->required()
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("ESTIMATES", a.estimates,
                   "folder of estimates, 00.txt ...; several: a system each, beside each other")
      ->required()
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("--sequences", a.sequences,
                   "sequences to judge, as 09,10; all of TRUTHS without it")
      ->delimiter(',');
  command->add_option("-o,--out", a.out, "folder for the devkit's tables and plots")
      ->type_name(kOutput);
  command->add_option("--plot-format", a.format, "format of the plots; none: tables alone")
      ->check(CLI::IsMember(kitti_plot_formats()))
      ->capture_default_str();
  command->add_flag("--json", *json, kJsonText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments, json] { print_kitti(*arguments, *json); });
}

}  // namespace placegraph::apps
