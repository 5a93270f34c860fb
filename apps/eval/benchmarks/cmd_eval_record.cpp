#include "apps/eval/benchmarks/cmd_eval_record.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/eval/cmd_eval.h"
#include "apps/eval/benchmarks/eval_record.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_eval_record_command(CLI::App& eval_group, const std::string& program) {
  auto arguments = std::make_shared<EvalRecordArguments>();
  EvalRecordArguments& a = *arguments;
  auto system = std::make_shared<std::string>();
  CLI::App* command = eval_group.add_subcommand(
      "record", "Record the figures of runs in a file, for `eval gate`");
  command->footer(
      "placegraph eval record poses.txt run1.tum run2.tum --name 00 --out baseline.json");
  command
      ->add_option("TRUTH", a.evaluation.truth,
                   "true trajectory, the folder of a sequence, or a folder of trajectories")
      ->required()
      ->check(CLI::ExistingPath);
  command
      ->add_option("RUN", a.evaluation.estimates,
                   "trajectories of runs over the sequence, output folders of `run`, or folders "
                   "whose files are paired with TRUTH's by name: a run each")
      ->required()
      ->check(CLI::ExistingPath);
  command->add_option("--name", a.name, "name of the sequence; default: that of TRUTH");
  command->add_option("--system", *system, "version of the judged system, to note in the record");
  command->add_option("-o,--out", a.out, "file to write")->type_name(kOutput)->required();
  command->add_flag("--append", a.append,
                    "add the runs to those of the file, and sequences that it lacks");
  add_protocol_options(*command, a.evaluation);
  command->add_flag("--force", a.evaluation.force, kForceText);
  command->callback([arguments, system, program] {
    if (!system->empty()) arguments->programs.push_back(*system);
    arguments->programs.push_back(program);
    print(to_text(eval_record(*arguments)));
  });
}

}  // namespace placegraph::apps
