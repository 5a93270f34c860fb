#pragma once
#include <string>
#include <vector>

namespace placegraph::apps {

enum class ConfigForm { kList, kYaml, kMarkdown };

struct ConfigArguments {
  std::string of = "run";             ///< whose options: run or flight
  std::string config;                 ///< YAML file to start from; empty: the defaults
  std::vector<std::string> settings;  ///< "key=value"
  ConfigForm form = ConfigForm::kList;
  std::string out;     ///< file to write; empty: none
  bool force = false;  ///< overwrite it
};

/// `placegraph config`: every option as it stands after the file and the settings, in the form
/// asked for; written to `out` if there is one. Throws ArgumentError, FileError.
std::string config(const ConfigArguments& arguments);

}  // namespace placegraph::apps
