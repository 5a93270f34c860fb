#pragma once
#include <placegraph/eval/gate/gate.h>

#include <string>
#include <vector>

namespace placegraph::apps {

struct EvalGateArguments {
  std::string baseline;                 ///< a record
  std::vector<std::string> candidates;  ///< records of runs of one system
  std::string rules;                    ///< a file; empty: the default rules
  GateOptions options;                  ///< names of the systems are those of the files
  std::string markdown, junit;          ///< files to write; empty: none
  bool force = false;                   ///< overwrite them
};

/// Judges candidates by a baseline: `placegraph eval gate`.
/// Writes the requested files with any verdict. Throws ArgumentError, FileError.
GateResult eval_gate(const EvalGateArguments& arguments);

}  // namespace placegraph::apps
