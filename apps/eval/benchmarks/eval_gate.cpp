#include "apps/eval/benchmarks/eval_gate.h"

#include <placegraph/eval/gate/gate.h>
#include <placegraph/eval/gate/gate_rules.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/distinct_paths.h>
#include <placegraph/io/files/output_file.h>
#include <placegraph/pipeline/results/gate_files.h>

namespace placegraph::apps {
namespace {

void check_gate_outputs(const EvalGateArguments& arguments) {
  std::vector<NamedPath> outputs, inputs = {{"BASELINE", arguments.baseline}};
  for (const std::string& candidate : arguments.candidates)
    inputs.push_back({"CANDIDATE", candidate});
  if (!arguments.rules.empty()) inputs.push_back({"--rules", arguments.rules});
  if (!arguments.markdown.empty()) outputs.push_back({"--summary", arguments.markdown});
  if (!arguments.junit.empty()) outputs.push_back({"--junit", arguments.junit});
  for (const NamedPath& output : outputs) require_free(output.path, arguments.force);
  require_distinct_paths(outputs, inputs);
}

}  // namespace

GateResult eval_gate(const EvalGateArguments& arguments) {
  require(!arguments.candidates.empty(), "CANDIDATE: no record is given");
  check_gate_outputs(arguments);
  const GateRules rules =
      arguments.rules.empty() ? default_rules() : read_gate_rules(arguments.rules);
  const Record baseline = read_record(arguments.baseline);
  std::vector<Record> candidates;
  for (const std::string& path : arguments.candidates) candidates.push_back(read_record(path));
  GateOptions options = arguments.options;
  options.baseline = arguments.baseline;
  options.candidate = arguments.candidates.front();
  if (arguments.candidates.size() > 1)
    options.candidate += " and " + std::to_string(arguments.candidates.size() - 1) + " more";
  GateResult result = judge(baseline, merged(candidates, arguments.candidates), rules, options);
  if (!arguments.markdown.empty()) write_file(arguments.markdown, to_markdown(result));
  if (!arguments.junit.empty()) write_file(arguments.junit, to_junit(result));
  return result;
}

}  // namespace placegraph::apps
