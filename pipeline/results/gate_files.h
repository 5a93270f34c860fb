#pragma once
#include <placegraph/eval/gate/gate_rules.h>
#include <placegraph/eval/gate/record.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads the file of a record of runs. Throws FileError as parse_record().
[[nodiscard]] Record read_record(const std::string& path);

/// Reads a file of rules of a gate. Throws FileError as parse_rules().
[[nodiscard]] GateRules read_gate_rules(const std::string& path);

}  // namespace placegraph
