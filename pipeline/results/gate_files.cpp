#include <placegraph/io/files/text_file.h>
#include <placegraph/pipeline/results/gate_files.h>

namespace placegraph {
namespace {

std::string text_of_file(const std::string& path) {
  TextFile file(path);
  std::string text;
  for (std::string_view line; file.next(line);) text.append(line).append("\n");
  return text;
}

}  // namespace

Record read_record(const std::string& path) { return parse_record(text_of_file(path), path); }

GateRules read_gate_rules(const std::string& path) {
  return parse_rules(text_of_file(path), path);
}

}  // namespace placegraph
