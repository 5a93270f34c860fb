#pragma once
#include <placegraph/io/config/yaml_config.h>

#include <string>
#include <vector>

#include "apps/config/config.h"
#include "apps/shipped/shipped_files.h"
#include "apps/support/output.h"

namespace placegraph::apps {

/// The options of a command as a text in the wanted form, up to the wanted level.
std::string config_text(const ConfigArguments& arguments, const std::vector<OptionEntry>& all);

/// The text of `Options` after the file and the settings. Throws ArgumentError, FileError.
template <class Options>
std::string config_of(const ConfigArguments& arguments) {
  Options options;
  const LogSink notes = option_notes();
  if (!arguments.config.empty()) read_options(config_path(arguments.config), options, notes);
  for (const std::string& setting : arguments.settings) set_option(options, setting, notes);
  options.check();
  return config_text(arguments, list_options(options));
}

}  // namespace placegraph::apps
