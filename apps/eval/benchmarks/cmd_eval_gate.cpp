#include "apps/eval/benchmarks/cmd_eval_gate.h"

#include <placegraph/eval/gate/gate.h>
#include <placegraph/graph/core/error.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/eval/benchmarks/eval_gate.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_eval_gate_command(CLI::App& eval_group) {
  auto arguments = std::make_shared<EvalGateArguments>();
  auto json = std::make_shared<bool>(false), changed = std::make_shared<bool>(false);
  EvalGateArguments& a = *arguments;
  CLI::App* command = eval_group.add_subcommand(
      "gate", "Judge whether a change is a regression: exit code 0 no, 1 yes, 2 cannot be judged");
  command->footer("placegraph eval gate baseline.json candidate.json --summary report.md");
  command->add_option("BASELINE", a.baseline, "record of `eval record`")
      ->required()
      ->check(CLI::ExistingFile);
  command
      ->add_option("CANDIDATE", a.candidates,
                   "record to judge; several are runs of one system, one behind the other")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("--rules", a.rules, "file of rules, a line SEQUENCE | FIGURE | RULE each")
      ->check(CLI::ExistingFile);
  command
      ->add_option("--level", a.options.level,
                   "probability that an equal system is called worse by the tests of runs")
      ->capture_default_str();
  command->add_flag("--changed", *changed, "leave out figures that are the same to the digit");
  command->add_flag("--json", *json, kJsonText);
  command->add_option("--summary", a.markdown, "write a page for a pull request")
      ->type_name(kOutput);
  command->add_option("--junit", a.junit, "write JUnit's XML, a test case for each figure")
      ->type_name(kOutput);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments, json, changed] {
    const GateResult result = eval_gate(*arguments);
    print(*json ? to_json(result) : to_text(result, !*changed));
    if (result.verdict == Standing::kRegressed) throw NoResult("regressed: " + result.sentence);
    if (result.verdict == Standing::kUnjudged)
      throw ArgumentError("cannot be judged: " + result.sentence);
  });
}

}  // namespace placegraph::apps
