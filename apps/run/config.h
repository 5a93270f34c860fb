#pragma once
#include <placegraph/graph/core/options.h>

#include <string>
#include <vector>

namespace placegraph::apps {

enum class ConfigForm {
  kYaml,     ///< as `--config` reads it
  kList,     ///< one option per line
  kMarkdown  ///< docs/options.md
};

struct ConfigArguments {
  std::string of = "run";             ///< whose options: run or flight
  std::string config;                 ///< YAML file to start from; empty: the defaults
  std::vector<std::string> settings;  ///< "key=value"
  ConfigForm form = ConfigForm::kYaml;
  OptionLevel level = OptionLevel::kBasic;  ///< the last level that is printed
  std::string out;                          ///< file to write; empty: none
  bool force = false;                       ///< overwrite it
};

/// `placegraph config`: the options with their values after the file and the settings.
/// Also written to `out` if that is given. Throws ArgumentError, FileError.
std::string config(const ConfigArguments& arguments);

}  // namespace placegraph::apps
