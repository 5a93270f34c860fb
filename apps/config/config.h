#pragma once
#include <placegraph/graph/core/options.h>

#include <string>
#include <vector>

namespace placegraph::apps {

enum class ConfigForm {
  kYaml,     ///< YAML for `--config`
  kList,     ///< one option per line
  kMarkdown  ///< Markdown, as in docs/options.md
};

struct ConfigArguments {
  std::string of = "run";             ///< command with these options: run or flight
  std::string config;                 ///< YAML file to start from; empty: the defaults
  std::vector<std::string> settings;  ///< "key=value"
  ConfigForm form = ConfigForm::kYaml;
  OptionLevel level = OptionLevel::kBasic;  ///< last level to print
  std::string out;                          ///< file to write; empty: none
  bool force = false;                       ///< overwrite `out`
};

/// Options with their values after the file and the settings: `placegraph config`.
/// They are also written to `out` if it is given. Throws ArgumentError, FileError.
std::string config(const ConfigArguments& arguments);

}  // namespace placegraph::apps
